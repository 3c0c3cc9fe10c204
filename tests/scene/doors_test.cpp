#include <gtest/gtest.h>

#include <cmath>

#include "drawing.hpp"

namespace muster::scene {
namespace {

constexpr int plaster = 0, wood = 1;

// A wall from west to east with a door from 4 m to 4.9 m, 2 m high.
Scene room(bool open) { return Scene({wall(0, 0, 12, 0, 3, plaster)}, {{0, 4, 0.9, 2, wood, open}}, materials); }

std::vector<int> northward(const Scene& scene, double x, double z = 1) {
  const std::vector<int> all = counts(scene, {x, -1, z}, {x, 1, z});
  return {all[plaster], all[wood]};
}

const std::vector<int> nothing{0, 0}, the_wall{1, 0}, the_door{0, 1};

TEST(Door, ClosedCountsAsItsOwnMaterialInsteadOfTheWall) {
  const Scene scene = room(false);
  EXPECT_EQ(northward(scene, 4.5), the_door);
  EXPECT_EQ(northward(scene, 3.5), the_wall);
  const auto found = crossings(scene, {4.5, -1, 1}, {4.5, 1, 1});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].wall, 0);
  EXPECT_EQ(found[0].door, 0);
  EXPECT_EQ(found[0].material, wood);
  EXPECT_EQ(found[0].fraction, 0.5);
  EXPECT_EQ(found[0].cos_incidence, 1);
}

TEST(Door, OpenCountsNothing) {
  const Scene scene = room(true);
  EXPECT_EQ(northward(scene, 4.5), nothing);
  EXPECT_TRUE(crossings(scene, {4.5, -1, 1}, {4.5, 1, 1}).empty());
  EXPECT_EQ(northward(scene, 3.5), the_wall);
}

TEST(Door, TurnsInPlace) {
  Scene scene = room(false);
  scene.set_open(0, true);
  EXPECT_TRUE(scene.is_open(0));
  EXPECT_EQ(northward(scene, 4.5), nothing);
  scene.set_open(0, false);
  EXPECT_FALSE(scene.is_open(0));
  EXPECT_EQ(northward(scene, 4.5), the_door);
}

TEST(Door, TakesItsFirstPostAndLeavesItsSecond) {
  const Scene scene = room(false);
  const double second = 4.9;
  EXPECT_EQ(northward(scene, 4 - step), the_wall);
  EXPECT_EQ(northward(scene, 4), the_door);
  EXPECT_EQ(northward(scene, second - step), the_door);
  EXPECT_EQ(northward(scene, second), the_wall);
}

TEST(Door, IsPlacedFromTheFirstEndOfAWallThatRunsWest) {
  const Scene scene({wall(12, 0, 0, 0, 3, plaster)}, {{0, 4, 1, 2, wood, false}}, materials);
  EXPECT_EQ(northward(scene, 7.5), the_door);
  EXPECT_EQ(northward(scene, 4.5), the_wall);
  EXPECT_EQ(northward(scene, 7), the_door);
  EXPECT_EQ(northward(scene, 8), the_wall);
}

TEST(Door, HasTheWallOverIt) {
  Scene scene = room(false);
  EXPECT_EQ(northward(scene, 4.5, 2 - step), the_door);
  EXPECT_EQ(northward(scene, 4.5, 2), the_wall);
  scene.set_open(0, true);
  EXPECT_EQ(northward(scene, 4.5, 2 - step), nothing);
  EXPECT_EQ(northward(scene, 4.5, 2), the_wall);
}

TEST(Door, StandsOnItsWallsBase) {
  Wall upstairs = wall(0, 0, 12, 0, 3, plaster);
  upstairs.base = 3;
  const Scene scene({upstairs}, {{0, 4, 0.9, 2, wood, false}}, materials);
  EXPECT_EQ(northward(scene, 4.5, 1), nothing);
  EXPECT_EQ(northward(scene, 4.5, 4), the_door);
  EXPECT_EQ(northward(scene, 4.5, 5.5), the_wall);
}

TEST(Door, TallerThanItsWallEndsWithIt) {
  const Scene scene({wall(0, 0, 12, 0, 1.5, plaster)}, {{0, 4, 0.9, 2, wood, false}}, materials);
  EXPECT_EQ(northward(scene, 4.5, 1.5 - step), the_door);
  EXPECT_EQ(northward(scene, 4.5, 1.5), nothing);
}

TEST(Door, MayTakeUpItsWholeWall) {
  const Scene oblique({wall(0, 0, 1, 1, 3, plaster)}, {{0, 0, 1.41421356, 2, wood, false}}, materials);
  EXPECT_EQ(northward(oblique, 0), the_door);
  EXPECT_EQ(northward(oblique, 0.5), the_door);
  EXPECT_EQ(northward(oblique, 1 - step), the_door);
  EXPECT_EQ(northward(oblique, 1), nothing);
}

// Snapping may shorten a wall by almost two steps; a door that takes up all of it as drawn stays a door.
TEST(Door, MayTakeUpItsWholeWallAsDrawn) {
  const double low = -0.49 * step, high = 2 + 0.49 * step;
  const Scene scene({wall(low, low, high, high, 3, plaster)}, {{0, 0, (high - low) * std::sqrt(2), 2, wood, false}},
                    materials);
  EXPECT_EQ(northward(scene, 0), the_door);
  EXPECT_EQ(northward(scene, 1 - step), the_door);
  EXPECT_EQ(counts(scene, {2 - step, 1, 1}, {2 - step, 3, 1})[wood], 1);
}

// A wall with a door is four walls: two beside the door, the leaf, and the lintel. Posts lie on the lattice here.
TEST(Door, CountsLikeTheWallsThatItDividesItsWallInto) {
  SmallLattice lattice(31);
  const int directions[][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {3, 4}, {-3, 4}, {4, -3}, {-4, -3}};
  for (int i = 0; i < 5'000; ++i) {
    const auto& [dx, dy] = directions[lattice.below(8)];
    const int from = lattice.below(3), to = from + 1 + lattice.below(2), end = to + lattice.below(2);
    const double unit = std::abs(dx) + std::abs(dy) > 1 ? 5 : 1;
    const double x = lattice.coordinate(), y = lattice.coordinate(), top = 1 + lattice.below(3);
    const auto part = [&](int first, int last, double height, int material) {
      return wall(x + first * dx, y + first * dy, x + last * dx, y + last * dy, height, material);
    };
    const Scene whole({part(0, end, 4, plaster)}, {{0, from * unit, (to - from) * unit, top, wood, false}}, materials);
    std::vector<Wall> parts{part(from, to, top, wood), part(from, to, 4 - top, plaster)};
    parts[1].base = top;
    if (from > 0) parts.push_back(part(0, from, 4, plaster));
    if (end > to) parts.push_back(part(to, end, 4, plaster));
    const Scene divided(parts, {}, materials);
    for (int k = 0; k < 20; ++k) {
      const Point p = lattice.point(), q = lattice.point();
      ASSERT_EQ(counts(whole, p, q), counts(divided, p, q));
    }
  }
}

}  // namespace
}  // namespace muster::scene
