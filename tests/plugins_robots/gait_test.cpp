// robots.gait between a command and physics: legs are asked for without a jump, and robots walk as they are told.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "plugins/robots/dead_reckoning.hpp"
#include "plugins/robots/tripod_gait.hpp"
#include "robot_world.hpp"

namespace {

using namespace muster;
using namespace muster::test;

// One RDK that control.steady steers.
Simulation told(const Folder& folder, const std::string& steer, const std::string& more = "") {
  return world_of(folder,
                  "<robot name=\"r\" model=\"rdk\" at=\"0 0 0\"/><physics.simbody step=\"0.002\"/>"
                  "<control.steady robot=\"r\" " +
                      steer + "/>" + more,
                  {}, "dt=\"0.01\" until=\"60\" seed=\"1\"");
}

template <class After>
void run_until(Simulation& run, double time, After after) {
  while (run.time() < time - 1e-9) {
    run.step();
    after();
  }
}

TEST(Gait, WalksAsFastAsAskedAndComesToStand) {
  Folder folder;
  Simulation run = told(folder, "v=\"0.12\" until=\"10\"");
  double x = 0;
  run_until(run, 10, [&] {
    if (std::abs(run.time() - 5) < 0.005) x = row<Pose>(run, "robot/r/pose").x;
  });
  EXPECT_NEAR((row<Pose>(run, "robot/r/pose").x - x) / 5, 0.12, 0.05 * 0.12);
  run_until(run, 14, [] {});
  const Gait asked = row<Gait>(run, "robot/r/gait");
  const Legs legs = row<Legs>(run, "robot/r/legs");
  for (int i = 0; i < 6; ++i) {
    EXPECT_EQ(asked.rate[i], 0);
    EXPECT_NEAR(std::remainder(legs.angle[i], whole_turn), 0, 0.02);  // upright
  }
  EXPECT_LT(std::abs(row<Twist>(run, "robot/r/twist").vx), 1e-3);
}

TEST(Gait, AsksForNoJumps) {
  Folder folder;
  Simulation run = told(folder, "v=\"0.05\" w=\"0.5\" until=\"3\"", "<robots.gait max_frequency=\"0.8\"/>");
  const double fastest = whole_turn / 0.35 * 0.8;  // of a swing without a sweep
  Gait before = row<Gait>(run, "robot/r/gait");
  run_until(run, 6, [&] {
    const Gait now = row<Gait>(run, "robot/r/gait");
    for (int i = 0; i < 6; ++i) {
      const double reached = before.angle[i] + 0.01 * before.rate[i];
      EXPECT_NEAR(std::remainder(now.angle[i] - reached, whole_turn), 0, 1e-9);
      EXPECT_LT(std::abs(now.rate[i]), 1.2 * fastest);
    }
    before = now;
  });
}

TEST(Gait, TurnsBothWaysAndOnTheSpot) {
  const auto turned = [](const std::string& steer) {
    Folder folder;
    Simulation run = told(folder, steer);
    run_until(run, 8, [] {});
    const Pose p = row<Pose>(run, "robot/r/pose");
    EXPECT_GT(p.z, -0.05);
    return std::array{yaw_of(p), std::hypot(p.x, p.y)};
  };
  const auto left = turned("v=\"0\" w=\"0.4\""), right = turned("v=\"0\" w=\"-0.4\"");
  EXPECT_GT(left[0], 0.5);
  EXPECT_LT(right[0], -0.5);
  EXPECT_LT(left[1], 0.15);
  EXPECT_GT(turned("v=\"0.1\" w=\"0.2\"")[0], 0.3);
}

TEST(Gait, WalksBackwards) {
  Folder folder;
  Simulation run = told(folder, "v=\"-0.1\"");
  run_until(run, 6, [] {});
  EXPECT_LT(row<Pose>(run, "robot/r/pose").x, -0.3);
}

TEST(Gait, MoreThanItCanIsLessInTheSameProportion) {
  Folder folder;
  Simulation run = told(folder, "v=\"9\"", "<robots.gait max_frequency=\"0.5\"/>");
  run_until(run, 4, [] {});
  EXPECT_EQ(run.table("robot/r/gait_clock").at(0, 2), 0.5);
}

}  // namespace
