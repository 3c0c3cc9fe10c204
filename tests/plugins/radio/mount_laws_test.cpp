// Pose of an antenna, from the body that carries it.
#include <gtest/gtest.h>

#include "radio_links/mount.hpp"

namespace muster {
namespace {

constexpr double quarter = 1.5707963267948966;

void expect_pose(const Pose& found, const Pose& expected) {
  EXPECT_NEAR(found.x, expected.x, 1e-12);
  EXPECT_NEAR(found.y, expected.y, 1e-12);
  EXPECT_NEAR(found.z, expected.z, 1e-12);
  EXPECT_NEAR(found.qw, expected.qw, 1e-12);
  EXPECT_NEAR(found.qx, expected.qx, 1e-12);
  EXPECT_NEAR(found.qy, expected.qy, 1e-12);
  EXPECT_NEAR(found.qz, expected.qz, 1e-12);
}

TEST(Mount, InTheWorldIsItsOwnPlace) {
  expect_pose(antenna_in_world({-1, 1, 2, 3, 0}, {0, 0, 0, 1, 0, 0, 0}), {1, 2, 3, 1, 0, 0, 0});
}

TEST(Mount, TurnsWithTheBody) {
  // Facing north, 0.1 m ahead of the body's origin is north of it; the antenna points to the body's left, which is
  // west.
  const Pose north{5, 6, 0.2, std::cos(quarter / 2), 0, 0, std::sin(quarter / 2)};
  expect_pose(antenna_in_world({0, 0.1, 0, 0.3, quarter}, north), {5, 6.1, 0.5, 0, 0, 0, 1});
}

TEST(Mount, TurnsWithABodyThatRollsAndPitches) {
  // Rolled by a quarter to the right, the body's up is to its right: south, for one that faces east.
  const Pose rolled{0, 0, 0, std::cos(quarter / 2), std::sin(quarter / 2), 0, 0};
  expect_pose(antenna_in_world({0, 0, 0, 1, 0}, rolled), {0, -1, 0, rolled.qw, rolled.qx, 0, 0});
}

}  // namespace
}  // namespace muster
