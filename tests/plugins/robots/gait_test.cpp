// robots.gait between a command and physics: legs are commanded without a jump, and robots walk as commanded.
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

// Straight on, odometry equals the body's path, within the small deflection of springs.
TEST(Gait, OdometryCountsStrides) {
  for (const std::string legs : {"true", "false"}) {
    for (const std::string v : {"0.12", "0.05", "-0.12"}) {
      Folder folder;
      Simulation run = world_of(folder,
                                "<robot name=\"r\" model=\"rdk\" at=\"1 2 0\" heading=\"0.5\"/><physics.simbody "
                                "step=\"0.002\" rigid_legs=\"" +
                                    legs + "\"/><control.steady robot=\"r\" v=\"" + v + "\"/><robots.odometry/>",
                                {}, "dt=\"0.01\" until=\"60\" seed=\"1\"");
      run_until(run, 20, [] {});
      const Pose at = row<Pose>(run, "robot/r/pose");
      const Odometry believed = row<Odometry>(run, "robot/r/odometry");
      EXPECT_LT(std::hypot(at.x - believed.x, at.y - believed.y), 0.005 * std::hypot(at.x - 1, at.y - 2)) << v;
      EXPECT_NEAR(believed.yaw, yaw_of(at), 0.005) << v;
    }
  }
}

// In turns feet slip, and a robot turns by about three quarters of its strides' angle. With that share a hexapod
// reaches its goal by its own odometry.
TEST(Gait, GoesToAPlaceByItsOwnOdometry) {
  Folder folder;
  Simulation run =
      world_of(folder,
               "<robot name=\"r\" model=\"rdk\" at=\"0 0 0\"/><physics.simbody step=\"0.002\"/>"
               "<control.waypoint name=\"c\" robot=\"r\" path=\"path.csv\" speed=\"0.12\" turn_speed=\"0.3\"/>"
               "<robots.odometry turn_share=\"0.75\"/>",
               {{"path.csv", "x[m],y[m]\n1.5,0\n1.5,1.5\n0,1.5\n0,0\n"}}, "dt=\"0.01\" until=\"120\" seed=\"1\"");
  const auto reached = [&run] { return run.table("instance/c/progress").at(0, 1); };
  while (!run.done() && reached() < 4) run.step();
  EXPECT_EQ(reached(), 4);
  const Pose at = row<Pose>(run, "robot/r/pose");
  const Odometry believed = row<Odometry>(run, "robot/r/odometry");
  EXPECT_LT(std::hypot(at.x, at.y), 0.1) << "after a square of 1.5 m";
  EXPECT_LT(std::abs(std::remainder(believed.yaw - yaw_of(at), whole_turn)), 0.1);
}

TEST(Gait, OdometryOfLegsHasItsNoise) {
  const auto believed = [](const std::string& noise) {
    Folder folder;
    Simulation run = told(folder, "v=\"0.1\"", "<robots.odometry noise=\"" + noise + "\"/>");
    run_until(run, 5, [] {});
    return row<Odometry>(run, "robot/r/odometry");
  };
  const Odometry plain = believed("0"), noisy = believed("0.05");
  const double off = std::hypot(noisy.x - plain.x, noisy.y - plain.y);
  EXPECT_GT(off, 1e-4);
  EXPECT_LT(off, 0.05);
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
