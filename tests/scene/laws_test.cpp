// Laws for any walls and any link, with any contacts between them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "drawing.hpp"

namespace muster::scene {
namespace {

constexpr double pi = 3.14159265358979323846;

// Doors at odd places, so that the reported numbers are not round.
Scene furnished(SmallLattice& lattice) {
  std::vector<Wall> walls = lattice.walls(20);
  std::vector<Door> doors;
  for (int row = 0; row < 20; row += 3) doors.push_back({row, 0.3, 0.6, 0.8, lattice.below(materials), false});
  return Scene(walls, doors, materials);
}

TEST(Law, BothDirectionsAreTheSameBitForBit) {
  SmallLattice lattice(2);
  int compared = 0;
  for (int i = 0; i < 50'000; ++i) {
    const Scene scene = furnished(lattice);
    Point p = lattice.point(), q = lattice.point();
    if (i % 2 == 1) p = {p.x + 0.1, p.y + 0.7, p.z / 3};
    const auto there = crossings(scene, p, q), back = crossings(scene, q, p);
    ASSERT_EQ(counts(scene, p, q), counts(scene, q, p));
    ASSERT_EQ(there.size(), back.size());
    for (std::size_t k = 0; k < there.size(); ++k, ++compared) {
      ASSERT_EQ(there[k].wall, back[k].wall);
      ASSERT_EQ(there[k].door, back[k].door);
      ASSERT_EQ(there[k].material, back[k].material);
      ASSERT_EQ(there[k].z, back[k].z);
      ASSERT_EQ(there[k].cos_incidence, back[k].cos_incidence);
      ASSERT_NEAR(there[k].fraction + back[k].fraction, 1, 1e-15);
    }
  }
  EXPECT_GT(compared, 20'000);
}

TEST(Law, AReportNamesThePlaceOfTheCrossing) {
  SmallLattice lattice(3);
  const std::vector<Wall> walls = lattice.walls(20);
  const Scene scene(walls, {}, materials);
  int compared = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Point p = lattice.point(), q = lattice.point();
    for (const Crossing& crossing : crossings(scene, p, q)) {
      const Wall& crossed = walls[crossing.wall];
      const double wall_x = crossed.x1 - crossed.x0, wall_y = crossed.y1 - crossed.y0;
      const double link_x = q.x - p.x, link_y = q.y - p.y, link_z = q.z - p.z;
      const double from_x = p.x + crossing.fraction * link_x - crossed.x0;
      const double from_y = p.y + crossing.fraction * link_y - crossed.y0;
      ASSERT_NEAR(wall_x * from_y - wall_y * from_x, 0, 1e-12);  // in the wall's plane
      ASSERT_NEAR(crossing.z, p.z + crossing.fraction * link_z, 1e-12);
      const double length = std::sqrt(link_x * link_x + link_y * link_y + link_z * link_z);
      const double along_normal = std::abs(link_x * wall_y - link_y * wall_x) / std::hypot(wall_x, wall_y);
      ASSERT_NEAR(crossing.cos_incidence, along_normal / length, 1e-12);
      ++compared;
    }
  }
  EXPECT_GT(compared, 10'000);
}

TEST(Law, ThePartsOfALinkAddUp) {
  SmallLattice lattice(4);
  for (int i = 0; i < 50'000; ++i) {
    const Scene scene = furnished(lattice);
    const Point p = lattice.point(), by{lattice.coordinate() - 3.0, lattice.coordinate() - 3.0, lattice.below(2) * 1.0};
    const int cut = 1 + lattice.below(3), all = cut + 1 + lattice.below(3);
    const auto at = [&](int k) { return Point{p.x + k * by.x, p.y + k * by.y, p.z + k * by.z}; };
    std::vector<int> sum = counts(scene, p, at(cut));
    const std::vector<int> rest = counts(scene, at(cut), at(all));
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += rest[k];
    ASSERT_EQ(sum, counts(scene, p, at(all)));
  }
}

TEST(Law, OrderAndDirectionOfWallsDoNotMatter) {
  SmallLattice lattice(5);
  for (int i = 0; i < 2'000; ++i) {
    std::vector<Wall> walls = lattice.walls(20);
    const Scene scene(walls, {}, materials);
    std::reverse(walls.begin(), walls.end());
    std::swap(walls[lattice.below(20)], walls[lattice.below(20)]);
    for (Wall& turned : walls) {
      if (lattice.below(2) == 1) std::swap(turned.x0, turned.x1), std::swap(turned.y0, turned.y1);
    }
    const Scene shuffled(walls, {}, materials);
    for (int k = 0; k < 50; ++k) {
      const Point p = lattice.point(), q = lattice.point();
      ASSERT_EQ(counts(scene, p, q), counts(shuffled, p, q));
    }
  }
}

TEST(Law, AWallInPiecesIsOneWall) {
  SmallLattice lattice(6);
  for (int i = 0; i < 5'000; ++i) {
    const double x = lattice.coordinate(), y = lattice.coordinate();
    const int dx = lattice.below(5) - 2, dy = lattice.below(5) - 2;
    if (dx == 0 && dy == 0) continue;
    const Scene whole({wall(x, y, x + 3 * dx, y + 3 * dy)}, {}, materials);
    const Scene parts({wall(x, y, x + dx, y + dy), wall(x + 3 * dx, y + 3 * dy, x + dx, y + dy)}, {}, materials);
    for (int k = 0; k < 20; ++k) {
      const Point p = lattice.point(), q = lattice.point();
      ASSERT_EQ(count(whole, p, q), count(parts, p, q));
    }
  }
}

struct Polygon {
  std::vector<Point> corners;

  std::vector<Wall> walls() const {
    std::vector<Wall> result;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Point &a = corners[i], &b = corners[(i + 1) % corners.size()];
      if (a.x != b.x || a.y != b.y) result.push_back(wall(a.x, a.y, b.x, b.y, 100));
    }
    return result;
  }

  // Winding number of the walls about a point that is not on one of them.
  int turns_about(const Point& p) const {
    double angle = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Point &a = corners[i], &b = corners[(i + 1) % corners.size()];
      angle += std::remainder(std::atan2(b.y - p.y, b.x - p.x) - std::atan2(a.y - p.y, a.x - p.x), 2 * pi);
    }
    return static_cast<int>(std::lround(angle / (2 * pi)));
  }
};

Polygon draw_polygon(SmallLattice& lattice) {
  Polygon result;
  const int corners = 3 + lattice.below(6);
  for (int i = 0; i < corners; ++i) result.corners.push_back(lattice.point());
  return result;
}

// Radios a little off every line through two lattice points, so that inside and outside are unambiguous; every second
// link runs straight through a corner all the same.
TEST(Law, LeavingAClosedRoomCrossesAnOddNumberOfWalls) {
  SmallLattice lattice(7);
  int odd = 0;
  for (int i = 0; i < 5'000; ++i) {
    const Polygon room = draw_polygon(lattice);
    const Scene scene(room.walls(), {}, materials);
    for (int k = 0; k < 20; ++k) {
      const Point a = lattice.point(), b = lattice.point();
      const Point& corner = room.corners[lattice.below(static_cast<int>(room.corners.size()))];
      const Point p{a.x + 1.0 / 256, a.y + 17.0 / 256, a.z};
      const Point through_corner{2 * corner.x - p.x, 2 * corner.y - p.y, b.z};
      const Point anywhere{b.x + 1.0 / 256, b.y + 17.0 / 256, b.z};
      const Point q = k % 2 == 0 ? through_corner : anywhere;
      const int parity = (room.turns_about(p) - room.turns_about(q)) & 1;
      ASSERT_EQ(count(scene, p, q) & 1, parity);
      odd += parity;
    }
  }
  EXPECT_GT(odd, 10'000);
}

// Even a radio on a wall or in a corner has one side, the same for all its links: no round trip changes it.
TEST(Law, ARoundTripCrossesAnEvenNumberOfWalls) {
  SmallLattice lattice(8);
  for (int i = 0; i < 5'000; ++i) {
    const Polygon room = draw_polygon(lattice);
    const Scene scene(room.walls(), {}, materials);
    for (int k = 0; k < 20; ++k) {
      const Point& corner = room.corners[lattice.below(static_cast<int>(room.corners.size()))];
      const Point p{corner.x, corner.y, 1}, q = lattice.point(), r = lattice.point();
      ASSERT_EQ((count(scene, p, q) + count(scene, q, r) + count(scene, r, p)) & 1, 0);
    }
  }
}

}  // namespace
}  // namespace muster::scene
