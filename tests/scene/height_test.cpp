// Walls cover the heights [base, base + height), at the exact place of the crossing.
#include <gtest/gtest.h>

#include "drawing.hpp"

namespace muster::scene {
namespace {

const Wall low_wall = wall(0, -5, 0, 5, 2);

TEST(Height, AQuadrotorAboveTheWallLosesTheCount) {
  const Scene scene({low_wall}, {}, materials);
  const Point scarab{-4, 0, 0.25};
  EXPECT_EQ(count(scene, scarab, {4, 0, 0.5}), 1);
  EXPECT_EQ(count(scene, scarab, {4, 0, 3.5}), 1);  // 1.875 m at the wall
  EXPECT_EQ(count(scene, scarab, {4, 0, 4}), 0);    // 2.125 m
  EXPECT_EQ(count(scene, {-4, 0, 3}, {4, 0, 3}), 0);
}

TEST(Height, TheTopIsOutsideAndTheBaseInside) {
  Wall raised = low_wall;
  raised.base = 1;  // 1 m to 3 m
  const Scene scene({raised}, {}, materials);
  EXPECT_EQ(count(scene, {-1, 0, 3}, {1, 0, 3}), 0);
  EXPECT_EQ(count(scene, {-1, 0, 3}, {1, 0, 3 - step}), 1);
  EXPECT_EQ(count(scene, {-1, 0, 1}, {1, 0, 1}), 1);
  EXPECT_EQ(count(scene, {-1, 0, 1}, {1, 0, 1 - step}), 0);
  EXPECT_EQ(count(scene, {-1, 0, 2}, {1, 0, 4}), 0);
  EXPECT_EQ(count(scene, {-1, 0, 0}, {1, 0, 2}), 1);
}

// A storey on a storey, at heights that are no multiples of the lattice step: every link takes one of the two.
TEST(Height, StackedWallsLeaveNoGapAndNoOverlap) {
  SmallLattice lattice(21);
  for (int i = 0; i < 20'000; ++i) {
    const double joint = 0.7 * (1 + lattice.below(8));
    Wall lower = low_wall, upper = low_wall, whole = low_wall;
    lower.height = joint;
    upper.base = joint;
    upper.height = 7.7 - joint;
    upper.material = 1;
    whole.height = 7.7;
    const Scene stacked({lower, upper}, {}, materials), single({whole}, {}, materials);
    const Point p{-1.0 * lattice.coordinate(), 0, 1.4 * lattice.coordinate()};
    const Point q{1.0 * lattice.coordinate(), 1, 1.4 * lattice.coordinate()};
    ASSERT_EQ(count(stacked, p, q), count(single, p, q));
  }
}

// Over the whole extent, a link passes an eight-millionth of a lattice step below the top, or above it.
TEST(Height, TheNearestPossibleMissIsDecided) {
  const double reach = 4'000'000 * step, nearly = 3'999'999 * step;
  EXPECT_EQ(count({low_wall}, {-nearly, 0, 2 - step}, {reach, 0, 2 + step}), 1);
  EXPECT_EQ(count({low_wall}, {-nearly, 0, 2 + step}, {reach, 0, 2 - step}), 0);
  EXPECT_EQ(count({low_wall}, {-reach, 0, 2 + step}, {reach, 0, 2 - step}), 0);
}

// Long links that meet the top of a long oblique wall exactly, or miss it by a part of a step.
TEST(Height, TiesOverTheWholeExtentAreDecided) {
  SmallLattice lattice(22, 1'000'000);
  for (int i = 0; i < 20'000; ++i) {
    const int before = 1 + lattice.coordinate(), after = 1 + lattice.coordinate();
    const int wall_before = 1 + lattice.coordinate(), wall_after = 1 + lattice.coordinate();
    const int slope = lattice.below(7) - 3;
    const auto along_link = [&](int k, int lift) {
      return Point{3 * k * step, k * step, 5 + (slope * k + lift) * step};
    };
    const Wall oblique =
        wall(-wall_before * step, 2 * wall_before * step, wall_after * step, -2 * wall_after * step, 5);
    EXPECT_EQ(count({oblique}, along_link(-before, 0), along_link(after, 0)), 0);
    EXPECT_EQ(count({oblique}, along_link(-before, -1), along_link(after, 0)), 1);
    EXPECT_EQ(count({oblique}, along_link(-before, 1), along_link(after, 0)), 0);
  }
}

}  // namespace
}  // namespace muster::scene
