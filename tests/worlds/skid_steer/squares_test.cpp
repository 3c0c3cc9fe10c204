// A square of 2 m by way points, driven by robots as people have them, on each backend: how far from the start they
// end, and how far their odometry is from where they are.
#include "stock.hpp"

namespace muster::test {
namespace {

struct Case {
  const StockRobot* robot;
  const char* physics;
  const char* speeds;  // of control.waypoint
  double most_drift;   // of the odometry at the end [m]
};

// The end may be as far from the start as a way point's tolerance; the rest is drift of the odometry. On the plane
// there is none, of two wheels beside casters without friction hardly any. The Burger's caster is a box that rubs: its
// wheels slip by millimetres in each turn (measured 1.4 and 3.4 mm). The Husky's odometry rests on slow turns under the
// same weight on all wheels; here it turns by 0.8 rad/s while it drives, which shifts weight and the centre of its
// turns (measured 41 and 46 mm on a way of 8 m). Bounds are 1.5 times what was measured, or a millimetre.
constexpr double tolerance = 0.02;
constexpr const char* slow = "speed=\"0.2\" turn_gain=\"4\" turn_speed=\"1\"";
constexpr const char* fast = "speed=\"0.4\" turn_gain=\"3\" turn_speed=\"0.8\"";
const Case cases[] = {
    {&burger, "physics.planar", slow, 1e-3},  {&burger, "physics.simbody", slow, 0.003},
    {&burger, "physics.ode", slow, 0.005},    {&waffle, "physics.planar", slow, 1e-3},
    {&waffle, "physics.simbody", slow, 1e-3}, {&waffle, "physics.ode", slow, 1e-3},
    {&husky, "physics.planar", fast, 1e-3},   {&husky, "physics.simbody", fast, 0.07},
    {&husky, "physics.ode", fast, 0.07},      {&burger, "physics.mujoco", slow, 0.003},
    {&waffle, "physics.mujoco", slow, 1e-3},  {&husky, "physics.mujoco", fast, 0.07},
};

std::vector<Case> built_cases() {
  std::vector<Case> result;
  for (const Case& one : cases) {
    if (!built({one.physics}).empty()) result.push_back(one);
  }
  return result;
}

class Square : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Robots, Square, testing::ValuesIn(built_cases()), [](const auto& made) {
  return std::string(made.param.robot->name) + "_" + std::string(made.param.physics).substr(8);
});

TEST_P(Square, Closes) {
  const Case& c = GetParam();
  if (c.robot->is_absent()) GTEST_SKIP() << "needs ../shared/data/urdf";
  Folder folder;
  folder.write("square.csv", "x[m],y[m]\n2,0\n2,2\n0,2\n0,0\n");
  Simulation run = stock_world(folder, *c.robot, c.physics,
                               std::string("<robots.odometry/><control.waypoint name=\"steer\" robot=\"r\" "
                                           "path=\"square.csv\" tolerance=\"0.02\" ") +
                                   c.speeds + "/>",
                               "70");
  while (!run.done()) run.step();
  EXPECT_EQ(run.table("instance/steer/progress").at(0, 1), 4) << "the way points are not reached in time";
  const Pose end = row<Pose>(run, "robot/r/pose");
  const Odometry believed = row<Odometry>(run, "robot/r/odometry");
  const double drift = std::hypot(end.x - believed.x, end.y - believed.y), closing = std::hypot(end.x, end.y);
  RecordProperty("closing_mm", std::to_string(1000 * closing));
  RecordProperty("drift_mm", std::to_string(1000 * drift));
  std::printf("[ measured ] closing error %.2f mm, drift of the odometry %.2f mm, %.3f degrees\n", 1000 * closing,
              1000 * drift, 180 / M_PI * std::remainder(yaw_of(end) - believed.yaw, 2 * M_PI));
  EXPECT_LE(drift, c.most_drift);
  EXPECT_LE(closing, tolerance + c.most_drift);
}

// The shipped world, whose way points count as reached within 5 cm.
TEST(SkidSteerWorld, Closes) {
  Simulation run(read_world(std::filesystem::path(MUSTER_SOURCE_DIR) / "worlds/skid_steer/world.xml", standard()),
                 standard(), {{MUSTER_PLUGINS_DIR}, 1, {}});
  while (!run.done()) run.step();
  EXPECT_EQ(run.table("instance/steer/progress").at(0, 1), 4) << "the way points are not reached in time";
  const Pose end = row<Pose>(run, "robot/husky/pose");
  std::printf("[ measured ] closing error %.2f mm\n", 1000 * std::hypot(end.x, end.y));
  EXPECT_LE(std::hypot(end.x, end.y), 0.05 + 0.07);
  EXPECT_TRUE(run.events().empty()) << run.events().front().message;
}

}  // namespace
}  // namespace muster::test
