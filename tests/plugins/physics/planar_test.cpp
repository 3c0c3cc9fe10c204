// physics.planar: exact arcs, and a velocity that changes no faster than declared.
#include "physics_world.hpp"

namespace {

using namespace muster;
using namespace muster::test;

TEST(Planar, ArcIsExact) {
  Folder folder;
  Simulation run = world_of(folder, R"(<robot name="a" at="1 2 0" heading="0.4"/><test.wheels v="0.3" w="0.5"/>
                                       <physics.planar acceleration="1000"/>)");
  run_to(run, 800);
  const auto pose = row<Pose>(run, "robot/a/pose");
  const double end = 0.4 + 0.5 * 8;
  EXPECT_NEAR(pose.x, 1 + 0.6 * (std::sin(end) - std::sin(0.4)), 1e-12);
  EXPECT_NEAR(pose.y, 2 - 0.6 * (std::cos(end) - std::cos(0.4)), 1e-12);
  EXPECT_NEAR(pose.qw, std::cos(end / 2), 1e-12);
  const auto wheels = row<Wheels>(run, "robot/a/wheels");
  EXPECT_NEAR(wheels.right - wheels.left, 0.5 * 8 * 0.21 / 0.05, 1e-9);
}

TEST(Planar, ARobotBelowTheGroundIsWarnedOfAlsoWhereItStepsEverySecondTick) {
  for (const char* every : {"1", "2"}) {
    Folder folder;
    Simulation run = world_of(folder, R"(<robot name="a" at="0 0 -1"/><test.wheels v="0.3"/><physics.planar every=")" +
                                          std::string(every) + "\"/>");
    run_to(run, 6);
    int warned = 0;
    for (const Event& event : run.events())
      warned += event.message.find("'a' starts 1000 mm below the ground") != std::string::npos;
    EXPECT_EQ(warned, 1) << every;
  }
}

// The step takes the command at its middle: the error falls with the square of the step.
TEST(Planar, IsOfSecondOrder) {
  std::vector<Pose> ends;
  for (const char* dt : {"0.04", "0.02", "0.01", "0.0005"}) {
    Folder folder;
    Simulation run = world_of(folder, R"(<robot name="a" at="0 0 0"/><test.wheels v="0.3" dv="0.1" dw="0.9"/>
                                         <physics.planar acceleration="1000"/>)",
                              1, dt);
    while (run.time() < 4 - 1e-9) run.step();
    ends.push_back(row<Pose>(run, "robot/a/pose"));
  }
  std::vector<double> errors;
  for (int i = 0; i < 3; ++i) errors.push_back(std::hypot(ends[i].x - ends[3].x, ends[i].y - ends[3].y));
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2, 0.2);
  EXPECT_NEAR(std::log2(errors[1] / errors[2]), 2, 0.2);
}

TEST(Planar, VelocityChangesNoFasterThanDeclared) {
  Folder folder;
  Simulation run = world_of(folder, R"(<robot name="a" at="0 0 0"/><test.wheels v="0.5" dv="0.5" dw="4"/>
                                       <physics.planar acceleration="0.5"/>)");
  auto before = row<Twist>(run, "robot/a/twist");
  double most = 0;
  for (int k = 0; k < 500; ++k) {
    run.step();
    const auto now = row<Twist>(run, "robot/a/twist");
    most = std::max(most, std::hypot(now.vx - before.vx, now.vy - before.vy) / 0.01);
    ASSERT_LE(std::abs(now.wz - before.wz) / 0.01, 0.5 / 0.105 + 1e-9);
    before = now;
  }
  EXPECT_LE(most, 0.5 + 1e-9);
  EXPECT_GT(most, 0.499);  // the course commands more
}

TEST(Planar, HeightAndTiltStay) {
  Folder folder;
  Simulation run =
      world_of(folder, R"(<robot name="a" at="0 0 0.25"/><test.wheels v="0.3" w="0.5"/><physics.planar/>)");
  run_to(run, 100);
  EXPECT_EQ(row<Pose>(run, "robot/a/pose").z, 0.25);
}

}  // namespace
