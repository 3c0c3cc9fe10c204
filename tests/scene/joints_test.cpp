// Walls that meet, and links that touch them: each counts like a link an infinitesimal step to the east (and north).
#include <gtest/gtest.h>

#include <numeric>

#include "drawing.hpp"

namespace muster::scene {
namespace {

// Links through the joint at (0, 0), at breast height.
const Point west{-2, 0, 1}, east{2, 0, 1}, south{0, -2, 1}, north{0, 2, 1};
const Point south_west{-2, -2, 1}, north_east{2, 2, 1}, north_west{-2, 2, 1}, south_east{2, -2, 1};

TEST(Joint, OfAStraightWallCountsOnce) {
  const std::vector<Wall> straight{wall(-3, 0, 0, 0), wall(0, 0, 3, 0)};
  EXPECT_EQ(count(straight, south, north), 1);
  EXPECT_EQ(count(straight, south_west, north_east), 1);
  EXPECT_EQ(count(straight, south_east, north_west), 1);
}

TEST(Joint, IsSharedByEndsThatSnapTogether) {
  for (const double miss : {-0.49 * step, -1e-13, 1e-13, 0.49 * step}) {
    const std::vector<Wall> straight{wall(-3, 0, 1, 1), wall(1 + miss, 1 + miss, 3, 2)};
    EXPECT_EQ(count(straight, {1, -2, 1}, {1, 3, 1}), 1) << miss;
    EXPECT_EQ(count(straight, {1 - step, -2, 1}, {1 - step, 3, 1}), 1) << miss;
  }
}

TEST(Joint, OfACornerCountsOnceOnTheWayThrough) {
  const std::vector<Wall> corner{wall(3, 0, 0, 0), wall(0, 0, 0, 3)};
  EXPECT_EQ(count(corner, south_west, north_east), 1);
  EXPECT_EQ(count(corner, Point{-1, -2, 1}, Point{1, 2, 1}), 1);
  EXPECT_EQ(count(corner, Point{-2, -1, 1}, Point{2, 1, 1}), 1);
}

TEST(Joint, OfACornerCountsTwiceOrNotOnTheWayPast) {
  EXPECT_EQ(count({wall(3, 0, 0, 0), wall(0, 0, 0, 3)}, south_east, north_west), 2);
  EXPECT_EQ(count({wall(-3, 0, 0, 0), wall(0, 0, 0, -3)}, south_east, north_west), 0);
}

TEST(Joint, OfAVTouchedAtItsTipCountsTwiceOrNot) {
  EXPECT_EQ(count({wall(-2, 2, 0, 0), wall(0, 0, 2, 2)}, west, east), 2);
  EXPECT_EQ(count({wall(-2, -2, 0, 0), wall(0, 0, 2, -2)}, west, east), 0);
  EXPECT_EQ(count({wall(2, -2, 0, 0), wall(0, 0, 2, 2)}, south, north), 2);
  EXPECT_EQ(count({wall(-2, -2, 0, 0), wall(0, 0, -2, 2)}, south, north), 0);
}

TEST(Joint, OfATCountsTheStemOnOneSideOnly) {
  const std::vector<Wall> tee{wall(-3, 0, 3, 0), wall(0, 0, 0, 3)};
  EXPECT_EQ(count(tee, south_west, north_east), 1);
  EXPECT_EQ(count(tee, south_east, north_west), 2);
}

TEST(Joint, OfFourWallsCountsTwoOnTheDiagonal) {
  const std::vector<Wall> cross{wall(0, 0, 3, 0), wall(0, 0, 0, 3), wall(0, 0, -3, 0), wall(0, 0, 0, -3)};
  EXPECT_EQ(count(cross, south_west, north_east), 2);
  EXPECT_EQ(count(cross, south_east, north_west), 2);
  EXPECT_EQ(count(cross, south, north), 1);
  EXPECT_EQ(count(cross, west, east), 1);
}

// Any chain of two walls, any link through their joint: once if the chain changes sides, else twice or not.
TEST(Joint, CountsLikeAShiftedRay) {
  SmallLattice lattice(11);
  int through = 0, past = 0;
  for (int i = 0; i < 100'000; ++i) {
    const Point joint = lattice.point(), a = lattice.point(), b = lattice.point();
    const double dx = lattice.coordinate() - 3, dy = lattice.coordinate() - 3;
    const auto side = [&](const Point& end) { return dx * (end.y - joint.y) - dy * (end.x - joint.x); };
    if (side(a) == 0 || side(b) == 0) continue;
    const bool changes_sides = (side(a) < 0) != (side(b) < 0);
    const int found = count({wall(a.x, a.y, joint.x, joint.y), wall(joint.x, joint.y, b.x, b.y)},
                            {joint.x - dx, joint.y - dy, 1}, {joint.x + dx, joint.y + dy, 1});
    if (changes_sides) {
      ASSERT_EQ(found, 1);
    } else {
      ASSERT_EQ(found % 2, 0);
    }
    ++(changes_sides ? through : past);
  }
  EXPECT_GT(through, 10'000);
  EXPECT_GT(past, 10'000);
}

TEST(Touch, ALinkAlongAWallDoesNotCrossIt) {
  const std::vector<Wall> level{wall(-1, 0, 1, 0)}, upright{wall(0, -1, 0, 1)}, oblique{wall(-1, -1, 1, 1)};
  EXPECT_EQ(count(level, west, east), 0);
  EXPECT_EQ(count(level, {-0.5, 0, 1}, {0.5, 0, 1}), 0);
  EXPECT_EQ(count(upright, south, north), 0);
  EXPECT_EQ(count(oblique, south_west, north_east), 0);
}

TEST(Touch, AVerticalLinkCrossesNoWall) {
  EXPECT_EQ(count({wall(-1, 0, 1, 0), wall(0, -1, 0, 1)}, {0, 0, -1}, {0, 0, 5}), 0);
  EXPECT_EQ(count({wall(-1, 0, 1, 0), wall(0, -1, 0, 1)}, {0, 0, 1}, {0, 0, 1}), 0);
}

TEST(Touch, ARadioOnAWallStandsNorthOrEastOfIt) {
  const std::vector<Wall> level{wall(-1, 0, 1, 0)}, upright{wall(0, -1, 0, 1)};
  EXPECT_EQ(count(level, {0, 0, 1}, north), 0);
  EXPECT_EQ(count(level, {0, 0, 1}, south), 1);
  EXPECT_EQ(count(upright, {0, 0, 1}, east), 0);
  EXPECT_EQ(count(upright, {0, 0, 1}, west), 1);
}

TEST(Touch, TwoWallsInOnePlaceAreTwoWalls) {
  EXPECT_EQ(count({wall(-1, 0, 1, 0), wall(1, 0, -1, 0)}, south, north), 2);
}

TEST(Touch, AThickWallCountsOnce) {
  Wall thick = wall(-1, 0, 1, 0);
  thick.thickness = 3;  // both radios stand within it
  EXPECT_EQ(count({thick}, {0, -1, 1}, {0, 1, 1}), 1);
  EXPECT_EQ(count({thick}, {0, 1, 1}, {0, 2, 1}), 0);
}

// Across the whole extent, a wall's end passes the link at the least distance that the lattice allows: a part in 10^14.
TEST(Touch, TheNearestPossibleMissIsDecided) {
  const std::int64_t x = 8'191'997, y = 8'191'000;  // coprime, in steps
  ASSERT_EQ(std::gcd(x, y), 1);
  std::int64_t u = 1;  // x v - y u = 1
  while ((y * u + 1) % x != 0) ++u;
  const std::int64_t v = (y * u + 1) / x;
  const auto at = [](std::int64_t east_steps, std::int64_t north_steps) {
    return Point{static_cast<double>(east_steps - 4'095'999) * step,
                 static_cast<double>(north_steps - 4'095'999) * step, 1};
  };
  const Point p = at(0, 0), q = at(x, y), left = at(u, v), right = at(x - u, y - v), far_left = at(0, y);
  EXPECT_EQ(count({wall(left.x, left.y, far_left.x, far_left.y)}, p, q), 0);
  EXPECT_EQ(count({wall(right.x, right.y, far_left.x, far_left.y)}, p, q), 1);
}

}  // namespace
}  // namespace muster::scene
