#include "plugins/robots/dead_reckoning.hpp"

#include <gtest/gtest.h>

namespace {

using namespace muster;

constexpr double pi = 3.14159265358979324;

TEST(DeadReckoning, OneStepIsTheArcExactly) {
  Odometry at{1, 2, 0, 0, 0};
  roll(at, 2 * pi / 4, pi / 2);  // a quarter of a circle of radius 1, to the left
  EXPECT_NEAR(at.x, 2, 1e-15);
  EXPECT_NEAR(at.y, 3, 1e-15);
  EXPECT_DOUBLE_EQ(at.yaw, pi / 2);
}

TEST(DeadReckoning, ManyStepsAreTheSameArc) {
  Odometry whole{0, 0, 0.3, 0, 0}, parts = whole;
  roll(whole, 5, 2.5);
  for (int i = 0; i < 1000; ++i) roll(parts, 5.0 / 1000, 2.5 / 1000);
  EXPECT_NEAR(parts.x, whole.x, 1e-12);
  EXPECT_NEAR(parts.y, whole.y, 1e-12);
}

TEST(DeadReckoning, StraightOnIsTheLimitOfFlatArcs) {
  for (const double turned : {0.0, 1e-12, 1.99e-4, 2.01e-4}) {
    Odometry at{0, 0, 0, 0, 0};
    roll(at, 1, turned);
    EXPECT_NEAR(at.x, 1 - turned * turned / 6, 1e-15) << turned;
    EXPECT_NEAR(at.y, turned / 2, 1e-12) << turned;
  }
}

TEST(DeadReckoning, BackwardsUndoesForwards) {
  Odometry at{0, 0, 1, 0, 0};
  roll(at, 3, -0.7);
  roll(at, -3, 0.7);
  EXPECT_NEAR(at.x, 0, 1e-15);
  EXPECT_NEAR(at.y, 0, 1e-15);
  EXPECT_DOUBLE_EQ(at.yaw, 1);
}

TEST(DeadReckoning, YawOfAPose) {
  for (double yaw = -3; yaw <= 3; yaw += 0.5)
    EXPECT_NEAR(yaw_of({0, 0, 0, std::cos(yaw / 2), 0, 0, std::sin(yaw / 2)}), yaw, 1e-15);
}

}  // namespace
