// Robots as people have them drive, turn and scan on each backend.
#include <cstring>

#include "stock.hpp"

namespace muster::test {
namespace {

struct Case {
  const StockRobot* robot;
  const char* physics;
};

class Stock : public testing::TestWithParam<Case> {};
std::vector<Case> all() {
  std::vector<Case> result;
  for (const StockRobot* robot : {&burger, &bare_burger, &waffle, &husky, &husky_like}) {
    for (const char* physics : backends) result.push_back({robot, physics});
  }
  return result;
}
INSTANTIATE_TEST_SUITE_P(Robots, Stock, testing::ValuesIn(all()), [](const auto& made) {
  return std::string(made.param.robot->name) + "_" + std::string(made.param.physics).substr(8);
});

// 0.2 m/s for 5 s, less half of the second that the slowest ramp takes to it.
TEST_P(Stock, Drives) {
  if (GetParam().robot->is_absent()) GTEST_SKIP() << "needs ../shared/data/urdf";
  Folder folder;
  Simulation run = stock_world(folder, *GetParam().robot, GetParam().physics,
                               "<control.steady robot=\"r\" v=\"0.2\" w=\"0\" until=\"5\"/>", "6");
  while (!run.done()) run.step();
  const Pose end = row<Pose>(run, "robot/r/pose");
  EXPECT_NEAR(end.x, 1, 0.01);
  EXPECT_NEAR(end.y, 0, 0.005);
  EXPECT_NEAR(yaw_of(end), 0, 0.005);
}

// 0.5 rad/s for 6 s, 3 rad, less a tick. A skid steer turns by its effective base, which is exact where the same weight
// is on all wheels.
TEST_P(Stock, Turns) {
  if (GetParam().robot->is_absent()) GTEST_SKIP() << "needs ../shared/data/urdf";
  Folder folder;
  Simulation run = stock_world(folder, *GetParam().robot, GetParam().physics,
                               "<control.steady robot=\"r\" v=\"0\" w=\"0.5\" until=\"6\"/>", "7");
  while (!run.done()) run.step();
  const Pose end = row<Pose>(run, "robot/r/pose");
  // The shared file has its centre of mass 7 cm to the right: two thirds of the load are there.
  const bool is_lopsided = GetParam().robot == &husky_like && std::string(GetParam().physics) != "physics.planar";
  std::printf("[ measured ] turned %.4f rad of 3, moved by %.1f mm\n", yaw_of(end), 1000 * std::hypot(end.x, end.y));
  EXPECT_NEAR(yaw_of(end), 3, is_lopsided ? 0.35 : 0.01);
  EXPECT_NEAR(std::hypot(end.x, end.y), 0, is_lopsided ? 0.3 : 0.002);
}

// Two engines with solvers of their own agree on turns by slip, also where the weight is uneven.
TEST(SkidSteer, EnginesAgree) {
  for (const StockRobot* robot : {&husky, &husky_like}) {
    if (robot->is_absent()) continue;
    Pose ends[2];
    for (int k = 0; k < 2; ++k) {
      Folder folder;
      Simulation run = stock_world(folder, *robot, k == 0 ? "physics.simbody" : "physics.ode",
                                   "<control.steady robot=\"r\" v=\"0.1\" w=\"0.5\" until=\"6\"/>", "7");
      while (!run.done()) run.step();
      ends[k] = row<Pose>(run, "robot/r/pose");
    }
    EXPECT_NEAR(yaw_of(ends[0]), yaw_of(ends[1]), 0.02) << robot->name;
    EXPECT_NEAR(std::hypot(ends[0].x - ends[1].x, ends[0].y - ends[1].y), 0, 0.02) << robot->name;
  }
}

// The state of all four wheels is on the blackboard: an instance made anew in a turn goes on with the same bits.
TEST(SkidSteer, MadeAgainGoesOnAlike) {
  for (const char* physics : built({"physics.simbody", "physics.ode", "physics.mujoco"})) {
    Pose ends[2];
    for (int k = 0; k < 2; ++k) {
      Folder folder;
      Simulation run =
          stock_world(folder, husky, physics, "<control.steady robot=\"r\" v=\"0.3\" w=\"0.5\" until=\"2\"/>", "3");
      while (!run.done()) {
        run.step();
        if (k == 1 && run.tick() % 17 == 5) run.remake("physics");
      }
      ends[k] = row<Pose>(run, "robot/r/pose");
    }
    EXPECT_EQ(std::memcmp(&ends[0], &ends[1], sizeof(Pose)), 0) << physics;
    EXPECT_GT(yaw_of(ends[0]), 0.8);
  }
}

struct Laser : testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Robots, Laser,
                         testing::Values(Case{&burger, "physics.planar"}, Case{&burger, "physics.simbody"},
                                         Case{&burger, "physics.ode"}, Case{&waffle, "physics.planar"},
                                         Case{&waffle, "physics.simbody"}, Case{&waffle, "physics.ode"}),
                         [](const auto& made) {
                           return std::string(made.param.robot->name) + "_" + std::string(made.param.physics).substr(8);
                         });

// A wall 1 m before the robot's middle; the laser is 0.032 m (Burger) and 0.064 m (Waffle) behind it.
TEST_P(Laser, Scans) {
  if (GetParam().robot->is_absent()) GTEST_SKIP() << "needs ../shared/data/urdf";
  Folder folder;
  Simulation run = stock_world(folder, *GetParam().robot, GetParam().physics,
                               "<material name=\"brick\" loss=\"6\"/><wall name=\"w\" from=\"1.05 -2\" to=\"1.05 2\" "
                               "material=\"brick\"/><sensors.laser name=\"laser\"/>",
                               "0.5");
  const double behind = GetParam().robot == &burger ? 0.032 : 0.064;
  std::size_t scans = 0;
  double ahead = 0;
  const auto look = [&] {
    const TableView queue = run.table("scan/*/message");
    if (queue.rows() == 0) return;
    Scan scan;
    std::memcpy(&scan, queue.table->now().data.data(), sizeof scan);
    const auto& bytes = *queue.table->now().blobs[static_cast<std::size_t>(scan.ranges) - 1];
    ASSERT_EQ(bytes.size(), 360 * sizeof(double));
    std::memcpy(&ahead, bytes.data(), sizeof ahead);
    EXPECT_EQ(scan.min_angle, 0);
    ++scans;
  };
  look();
  EXPECT_NEAR(ahead, 1 + behind, 0.0011) << "in millimetres";
  while (!run.done()) {
    run.step();
    look();
  }
  EXPECT_GE(scans, 3u) << "five times a second";
  EXPECT_NEAR(ahead, 1 + behind, 0.005) << "standing";
}

}  // namespace
}  // namespace muster::test
