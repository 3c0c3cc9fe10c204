// Level floors: crossings at all edges and corners.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <stdexcept>

#include "drawing.hpp"

namespace muster::scene {
namespace {

Floor rectangle(double x0, double y0, double x1, double y1, double z, int material = 0) {
  return {{x0, x1, x1, x0}, {y0, y0, y1, y1}, z, material};
}

int crossed(const std::vector<Floor>& floors, const Point& p, const Point& q) {
  return count(Scene({}, {}, materials, floors), p, q);
}

TEST(Floors, CountWhereTheLinkPassesThem) {
  const std::vector<Floor> floor{rectangle(0, 0, 4, 2, 3)};
  EXPECT_EQ(crossed(floor, {1, 1, 0}, {1, 1, 6}), 1);
  EXPECT_EQ(crossed(floor, {1, 1, 0}, {3, 1.9, 3.1}), 1);
  EXPECT_EQ(crossed(floor, {1, 1, 0}, {1, 1, 2.9}), 0);
  EXPECT_EQ(crossed(floor, {1, 1, 3.1}, {3, 1, 6}), 0);
  EXPECT_EQ(crossed(floor, {3, 1, 2}, {7, 1, 4}), 0);  // beside it: it is met at x = 5
  EXPECT_EQ(crossed(floor, {3, 1, 2}, {7, 1, 6}), 1);  // at x = 4, its eastern edge: as if a hair above, hence west
}

TEST(Floors, ARadioOnOneIsAboveIt) {
  const std::vector<Floor> floor{rectangle(0, 0, 4, 2, 3)};
  EXPECT_EQ(crossed(floor, {1, 1, 0}, {2, 1, 3}), 1);
  EXPECT_EQ(crossed(floor, {1, 1, 3}, {2, 1, 6}), 0);
  EXPECT_EQ(crossed(floor, {1, 1, 3}, {2, 1, 3}), 0);
}

TEST(Floors, AnOpeningAboutAnInwardCornerIsNotFloor) {
  const Floor arrow{{0, 4, 0, 1}, {0, 2, 4, 2}, 1, 0};  // its fourth corner points inwards
  EXPECT_EQ(crossed({arrow}, {2, 2, 0}, {2, 2, 2}), 1);
  EXPECT_EQ(crossed({arrow}, {0.5, 2.1, 0}, {0.5, 2.1, 2}), 0);
  for (int turn = 0; turn < 4; ++turn) {  // whichever corner is named first
    Floor turned = arrow;
    for (int i = 0; i < 4; ++i) turned.x[i] = arrow.x[(i + turn) % 4], turned.y[i] = arrow.y[(i + turn) % 4];
    SmallLattice lattice(5, 5);
    for (int k = 0; k < 2000; ++k) {
      const Point p = lattice.point(), q = lattice.point();
      ASSERT_EQ(crossed({turned}, p, q), crossed({arrow}, p, q));
    }
  }
}

// Quadrilaterals that tile the plan, their corners moved about except on the rim. Each link from below to above passes
// one of them, or none if it passes beside the rim, at any edges and corners.
TEST(Law, FloorsThatMeetLeaveNoGapAndNoOverlap) {
  SmallLattice lattice(11);
  int through = 0, beside = 0;
  for (int drawn = 0; drawn < 40; ++drawn) {
    constexpr int n = 4;  // cells a side, 2 m each
    std::array<std::array<Point, n + 1>, n + 1> corner;
    for (int i = 0; i <= n; ++i) {
      for (int j = 0; j <= n; ++j) {
        const bool on_rim = i % n == 0 || j % n == 0;
        corner[i][j] = {2. * i + (on_rim ? 0 : lattice.below(3) * 0.5), 2. * j + (on_rim ? 0 : lattice.below(3) * 0.5),
                        4};
      }
    }
    std::vector<Floor> tiles;
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        const Point at[] = {corner[i][j], corner[i + 1][j], corner[i + 1][j + 1], corner[i][j + 1]};
        tiles.push_back({{at[0].x, at[1].x, at[2].x, at[3].x}, {at[0].y, at[1].y, at[2].y, at[3].y}, 4, 0});
      }
    }
    const Scene apart({}, {}, materials, tiles), whole({}, {}, materials, {rectangle(0, 0, 8, 8, 4)});
    for (int k = 0; k < 2000; ++k) {
      Point p = lattice.point(), q = lattice.point();
      p.x = 2 * p.x - 4, q.y = 2 * q.y - 4;
      const int passed = count(apart, p, q);
      ASSERT_EQ(passed, count(whole, p, q))
          << p.x << ' ' << p.y << ' ' << p.z << " to " << q.x << ' ' << q.y << ' ' << q.z;
      if ((p.z < 4) != (q.z < 4)) ++(passed == 1 ? through : beside);
    }
  }
  EXPECT_GT(through, 10'000);
  EXPECT_GT(beside, 1000);
}

struct Storeys {
  std::vector<Wall> walls;
  std::vector<Floor> floors;

  explicit Storeys(SmallLattice& lattice) : walls(lattice.walls(12)) {
    for (int i = 0; i < 4; ++i) {
      const int x = lattice.below(5), y = lattice.below(5);
      floors.push_back(rectangle(x, y, x + 1 + lattice.below(4), y + 1 + lattice.below(4), lattice.coordinate(),
                                 lattice.below(materials)));
    }
  }
  Scene scene() const { return Scene(walls, {}, materials, floors); }
};

TEST(Law, FloorsAreTheSameBothWaysAndInParts) {
  SmallLattice lattice(12);
  int met = 0;
  for (int drawn = 0; drawn < 200; ++drawn) {
    const Scene scene = Storeys(lattice).scene();
    for (int k = 0; k < 100; ++k) {
      const Point p = lattice.point(), q = lattice.point();
      const Point middle{(p.x + q.x) / 2, (p.y + q.y) / 2, (p.z + q.z) / 2};
      const auto there = crossings(scene, p, q), back = crossings(scene, q, p);
      ASSERT_EQ(there.size(), back.size());
      for (std::size_t i = 0; i < there.size(); ++i) {
        ASSERT_EQ(there[i].floor, back[i].floor);
        ASSERT_EQ(there[i].cos_incidence, back[i].cos_incidence);
        ASSERT_NEAR(there[i].fraction + back[i].fraction, 1, 1e-15);
        if (there[i].floor < 0) continue;
        ASSERT_NEAR(p.z + there[i].fraction * (q.z - p.z), there[i].z, 1e-12);
        ++met;
      }
      ASSERT_EQ(count(scene, p, q), count(scene, p, middle) + count(scene, middle, q));
    }
  }
  EXPECT_GT(met, 3000);
}

TEST(Law, FloorsOfManyLinksAreThoseOfEach) {
  SmallLattice lattice(13);
  for (int drawn = 0; drawn < 30; ++drawn) {
    const Storeys storeys(lattice);
    for (const Scene& scene : {storeys.scene(), Scene({}, {}, materials, storeys.floors)}) {
      std::vector<Point> points;
      for (int i = 0; i < 40; ++i) points.push_back(lattice.point());
      std::vector<Pair> links;
      for (std::uint32_t a = 0; a < 40; ++a) {
        for (std::uint32_t b = 0; b < 40; ++b) links.push_back({a, b});
      }
      std::vector<int> counted;
      scene.counts(points, links, counted);
      for (std::size_t i = 0; i < links.size(); ++i) {
        const auto one = counts(scene, points[links[i].from], points[links[i].to]);
        std::map<int, int> reported;
        for (const Crossing& each : crossings(scene, points[links[i].from], points[links[i].to]))
          ++reported[each.material];
        for (int m = 0; m < materials; ++m) {
          ASSERT_EQ(counted[m * links.size() + i], one[m]);
          ASSERT_EQ(reported[m], one[m]);
        }
      }
    }
  }
}

std::string refusal(const Floor& floor) {
  try {
    const Scene scene({}, {}, 2, {rectangle(0, 0, 1, 1, 0), floor});
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Refusal, OfAFloor) {
  EXPECT_EQ(refusal({{0, 1, 0, 1}, {0, 0, 1, 1}, 0, 0}),
            "floor row 1: two of its edges cross; expected its corners in turn");
  EXPECT_EQ(refusal({{0, 1, 2, 3}, {0, 1, 2, 3}, 0, 0}), "floor row 1: has no area; expected four corners in turn");
  EXPECT_EQ(refusal({{0, 2000, 2000, 0}, {0, 0, 1, 1}, 0, 0}),
            "floor row 1: reaches beyond the scene; expected coordinates within 1000 m");
  EXPECT_EQ(refusal(rectangle(0, 0, 1, 1, 0, 2)),
            "floor row 1: material row 2 does not exist; expected one of the first 2");
  EXPECT_EQ(refusal({{0, 1, 1, 1}, {0, 0, 1, 1}, 0, 0}), "accepted");  // a triangle
}

}  // namespace
}  // namespace muster::scene
