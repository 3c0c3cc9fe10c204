// Mecanum drives: Muir and Neuman's kinematics, and their motion on each backend.
#include "driven.hpp"

namespace muster::test {
namespace {

using description::MecanumRates;
using description::PlanarMotion;

const description::Robot& base() {
  static const description::Robot robot = description::read_robot(models + "youbot.urdf");
  return robot;
}
const description::Mecanum& wheels() { return *base().drive->mecanum; }

TEST(YouBot, HasItsSourcesFigures) {
  EXPECT_TRUE(base().warnings.empty());
  EXPECT_NEAR(whole_mass(base()).mass, 20, 1e-9);
  EXPECT_EQ(wheels().wheelbase, 0.471);
  EXPECT_EQ(wheels().separation, 0.3);
  EXPECT_EQ(wheels().radius, 0.0475);
}

TEST(Mecanum, FourRatesForEachMotion) {
  const double r = 0.0475, arm = (0.471 + 0.3) / 2;
  const auto expect = [&](const PlanarMotion& motion, const MecanumRates& expected) {
    const MecanumRates rates = wheels().rates(motion);
    for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(rates[k], expected[k], 1e-12) << k;
  };
  expect({0.5, 0, 0}, {0.5 / r, 0.5 / r, 0.5 / r, 0.5 / r});
  expect({0, 0.5, 0}, {-0.5 / r, 0.5 / r, 0.5 / r, -0.5 / r});
  expect({0, 0, 0.5}, {-0.5 * arm / r, 0.5 * arm / r, -0.5 * arm / r, 0.5 * arm / r});
  const PlanarMotion any{0.3, -0.2, 0.7}, back = wheels().motion(wheels().rates(any));
  EXPECT_NEAR(back.vx, any.vx, 1e-12);
  EXPECT_NEAR(back.vy, any.vy, 1e-12);
  EXPECT_NEAR(back.w, any.w, 1e-12);
}

// A wheel rolls without slip along its roller's axle: there the hub's speed is the tread's.
TEST(Mecanum, RatesLeaveNoSlipAlongTheRollers) {
  const PlanarMotion motion{0.3, -0.2, 0.7};
  const MecanumRates rates = wheels().rates(motion);
  for (std::size_t k = 0; k < 4; ++k) {
    const double x = k < 2 ? 0.2355 : -0.2355, y = k % 2 == 0 ? 0.15 : -0.15;
    const Eigen::Vector3d hub(motion.vx - motion.w * y, motion.vy + motion.w * x, 0);
    const Eigen::Vector3d ground = hub - Eigen::Vector3d(0.0475 * rates[k], 0, 0);
    EXPECT_NEAR(ground.dot(description::Mecanum::hold(k)), 0, 1e-12) << k;
  }
}

TEST(Mecanum, RearWheelsThatAreHeldStall) {
  const auto stalled = [](const std::string& physics) {
    const Folder folder;
    Simulation run = driven(folder, "youbot", physics, "<control.steady robot=\"r\" v=\"0.2\"/><robots.odometry/>");
    run_to(run, 1);
    return row<Stall>(run, "robot/r/stall").stalled;
  };
  EXPECT_EQ(stalled("test.rear"), 1);
  EXPECT_EQ(stalled("physics.planar"), 0);
}

TEST(Mecanum, OfARobotWithoutRollersThatIsToGoSidewaysOneWarningIsGiven) {
  const Folder folder;
  const auto warnings = [&](const std::string& model, const std::string& twist) {
    Simulation run =
        driven(folder, model, "physics.planar", "<test.twist robot=\"r\" " + twist + "/><robots.odometry/>", "");
    for (int tick = 0; tick < 5; ++tick) run.step();
    std::string result;
    for (const Event& event : run.events())
      if (const auto at = event.message.find("robot 'r' "); at != event.message.npos)
        result += event.message.substr(at);
    return result;
  };
  EXPECT_EQ(
      warnings("scarab", "v=\"0.1\" side=\"0.1\""),
      "robot 'r' is commanded to go sideways (robot/r/sideways), and its model 'scarab' has no wheels with rollers "
      "(<mecanum>), so that it does not; expected a controller that turns, such as control.waypoint in place of "
      "control.strafe, or a model with rollers, such as youbot");
  EXPECT_EQ(warnings("scarab", "v=\"0.1\""), "");
  EXPECT_EQ(warnings("youbot", "v=\"0.1\" side=\"0.1\""), "");
}

class MecanumDrives : public testing::TestWithParam<const char*> {
 protected:
  bool is_planar() const { return std::string(GetParam()) == "physics.planar"; }
  Simulation twisted(const std::string& twist, const std::string& model = "youbot",
                     const std::string& more = "") const {
    return driven(folder, model, GetParam(), "<test.twist robot=\"r\" " + twist + "/><robots.odometry/>", more);
  }
  const Folder folder;
};
INSTANTIATE_TEST_SUITE_P(Backends, MecanumDrives, testing::ValuesIn(backends), name_of);

TEST_P(MecanumDrives, GoSidewaysAndKeepTheirHeading) {
  Simulation run = twisted("side=\"0.4\"");
  run_to(run, 5);
  const Pose p = row<Pose>(run, "robot/r/pose");
  std::printf("[ measured ] %.2f mm ahead, %.5f m to the left, %.6f rad\n", 1000 * p.x, p.y, yaw_of(p));
  EXPECT_NEAR(p.x, 0, 1e-3);
  EXPECT_NEAR(p.y, 0.4 * (5 - 0.2 - 0.01), 4e-3);  // less half of the ramp, and a tick
  EXPECT_NEAR(yaw_of(p), 0, 1e-3);
  EXPECT_NEAR(p.z, 0, 2e-4);
}

// A constant twist is a circle of radius |v| / w about a fixed point.
TEST_P(MecanumDrives, TwistsAreCircles) {
  Simulation run = twisted("v=\"0.3\" side=\"0.2\" w=\"0.5\"");
  run_to(run, 2);
  const Pose a = row<Pose>(run, "robot/r/pose");
  run_to(run, 5);
  const Pose b = row<Pose>(run, "robot/r/pose");
  const double turned = 1.5, radius = std::hypot(0.3, 0.2) / 0.5;
  EXPECT_NEAR(std::remainder(yaw_of(b) - yaw_of(a), 2 * M_PI), turned, is_planar() ? 1e-9 : 2e-3);
  EXPECT_NEAR(std::hypot(b.x - a.x, b.y - a.y), 2 * radius * std::sin(turned / 2), is_planar() ? 1e-9 : 3e-3);
}

TEST_P(MecanumDrives, CloseASquareWithoutTurning) {
  folder.write("square.csv", "x[m],y[m]\n2,0\n2,2\n0,2\n0,0\n");
  Simulation run =
      driven(folder, "youbot", GetParam(),
             "<robots.odometry/><control.strafe robot=\"r\" path=\"square.csv\" speed=\"0.5\" tolerance=\"0.01\"/>");
  double turned = 0, widest = 0;
  while (run.time() < 30) {
    run.step();
    const Pose p = row<Pose>(run, "robot/r/pose");
    turned = std::max(turned, std::abs(yaw_of(p)));
    widest = std::max(widest, std::min(p.x, p.y));
  }
  const Pose end = row<Pose>(run, "robot/r/pose");
  const auto believed = row<Odometry>(run, "robot/r/odometry");
  std::printf("[ measured ] closes within %.2f mm, drift %.2f mm, turned %.5f rad\n", 1000 * std::hypot(end.x, end.y),
              1000 * std::hypot(end.x - believed.x, end.y - believed.y), turned);
  EXPECT_GT(widest, 1.95) << "it was at the far corner";
  EXPECT_LT(std::hypot(end.x, end.y), 0.02);
  EXPECT_LT(std::hypot(end.x - believed.x, end.y - believed.y), is_planar() ? 1e-9 : 0.01);
  EXPECT_LT(turned, 5e-3);
}

// With its wheels held, each roller's contact pulls along its own axle with friction times its load. Four of them at 45
// degrees give friction m g / sqrt(2), ahead as sideways: a robot stops within v2 over twice that, per mass.
TEST_P(MecanumDrives, SlideToAStopAsRollersHold) {
  if (is_planar()) GTEST_SKIP() << "planar has ideal wheels";
  const std::string strong = model_with(
      folder, "youbot",
      {{"max_acceleration=\"21\" friction=\"0.8\"", "friction=\"0.2\""}, {"max_torque=\"4\"", "max_torque=\"100\""}});
  for (const std::string way : {"side", "v"}) {
    Simulation run = twisted(way + "=\"0.7\" until=\"2\"", strong);
    run_to(run, 1.98);
    const Pose from = row<Pose>(run, "robot/r/pose");
    const Twist t = row<Twist>(run, "robot/r/twist");
    ASSERT_NEAR(std::hypot(t.vx, t.vy), 0.7, 0.01);
    run_to(run, 3);
    const Pose p = row<Pose>(run, "robot/r/pose");
    const double expected = 0.7 * 0.7 / (2 * 0.2 * 9.81 / std::sqrt(2.0)),
                 way_gone = std::hypot(p.x - from.x, p.y - from.y);
    std::printf("[ measured ] %s: stops within %.4f m, expected %.4f\n", way.c_str(), way_gone, expected);
    EXPECT_NEAR(way_gone, expected + 0.007, 0.05 * expected);  // a tick later
  }
}

// Each wheel has its torque: ahead, four of them over the mass, with the wheels' own inertia.
TEST_P(MecanumDrives, AccelerateAsTheirTorqueAllows) {
  if (is_planar()) GTEST_SKIP() << "planar has ideal wheels";
  const std::string weak =
      model_with(folder, "youbot", {{"max_acceleration=\"21\"", ""}, {"max_torque=\"4\"", "max_torque=\"0.2\""}});
  const double inertia = 0.00157937, r = 0.0475, expected = 4 * 0.2 / r / (20 + 4 * inertia / (r * r));
  for (const std::string way : {"side", "v"}) {
    Simulation run = twisted(way + "=\"0.8\"", weak);
    run_to(run, 0.2);
    const Twist a = row<Twist>(run, "robot/r/twist");
    run_to(run, 0.6);
    const Twist b = row<Twist>(run, "robot/r/twist");
    EXPECT_NEAR(std::hypot(b.vx - a.vx, b.vy - a.vy) / 0.4, expected, 0.01 * expected) << way;
  }
}

TEST_P(MecanumDrives, HaveTheSameBitsAfterARestoreAndRemade) {
  expect_same_bits(folder, [&] { return twisted("v=\"0.5\" side=\"0.4\" w=\"1\""); });
}

TEST_P(MecanumDrives, OdometryFollows) {
  Simulation run = twisted("v=\"0.2\" side=\"0.2\" w=\"0.6\"");
  run_to(run, 5);
  const auto at = row<Odometry>(run, "robot/r/odometry");
  const Pose p = row<Pose>(run, "robot/r/pose");
  EXPECT_NEAR(std::hypot(at.x - p.x, at.y - p.y), 0, is_planar() ? 1e-9 : 0.01);
}

TEST(MecanumDrive, ScalesACommandBeyondItsSpeedInItsDirection) {
  Folder folder;
  Simulation run = driven(folder, "youbot", "physics.planar", "<test.twist robot=\"r\" v=\"1\" side=\"1\"/>");
  run_to(run, 3);
  const Twist t = row<Twist>(run, "robot/r/twist");
  EXPECT_NEAR(t.vx, 0.4, 1e-3);  // wheels of 16.84 rad/s: vx + vy = 0.8
  EXPECT_NEAR(t.vy, t.vx, 1e-12);
}

TEST(MecanumDrive, OfTwoBackendsIsHandedOverWithoutAJump) {
  Folder folder;
  for (const char* from : backends) {
    for (const char* to : backends) {
      Simulation run = driven(folder, "youbot", from, "<test.twist robot=\"r\" v=\"0.3\" side=\"0.3\" w=\"0.4\"/>");
      run_to(run, 2);
      const Pose before = row<Pose>(run, "robot/r/pose");
      const auto rear = row<Wheels>(run, "robot/r/rear_wheels");
      InstanceDeclaration made;
      made.plugin = to;
      run.swap("physics", made);
      const auto same = row<Wheels>(run, "robot/r/rear_wheels");
      EXPECT_EQ(rear.left, same.left);
      EXPECT_EQ(before.x, row<Pose>(run, "robot/r/pose").x);
      run.step();
      const Pose after = row<Pose>(run, "robot/r/pose");
      EXPECT_NEAR(std::hypot(after.x - before.x, after.y - before.y), 0.01 * std::hypot(0.3, 0.3), 3e-4) << from << to;
    }
  }
}

// Way points that had been reached on the longer path ended the run: row 2 of 1.
TEST(MecanumDrive, AShorterPathThatIsSwappedInEndsNoRun) {
  const Folder folder;
  folder.write("square.csv", "x[m],y[m]\n2,0\n2,2\n0,2\n0,0\n");
  folder.write("short.csv", "x[m],y[m]\n1,1\n");
  Simulation run = driven(folder, "youbot", "physics.planar",
                          "<robots.odometry/><control.strafe name='c' robot='r' path='square.csv' speed='0.5'/><at "
                          "t='14'><swap instance='c' plugin='control.strafe' robot='r' path='short.csv'/></at>");
  run_to(run, 14);
  ASSERT_GE(run.table("instance/c/progress").at(0, 0), 2);
  EXPECT_NO_THROW(run_to(run, 15));
  EXPECT_EQ(row<Command>(run, "robot/r/command").v, 0);
  EXPECT_EQ(row<Sideways>(run, "robot/r/sideways").v, 0);
}

TEST(MecanumDrive, FaultsAreNamed) {
  EXPECT_THAT(fault("youbot", {{"wheelbase=\"0.471\"", "wheelbase=\"0.47\""}}),
              testing::HasSubstr("<mecanum> wheelbase=\"0.47\" contradicts the joints, of which the front ones are "
                                 "0.471 m before the rear ones"));
  EXPECT_THAT(fault("youbot", {{"rear_left=\"rear_left_wheel_joint\"", "rear_left=\"front_left_wheel_joint\""}}),
              testing::HasSubstr("<mecanum> has a joint twice; expected four joints"));
  EXPECT_THAT(fault("youbot", {{"wheel_separation=", "wheel_seperation="}}), testing::HasSubstr("wheel_seperation"));
}

}  // namespace
}  // namespace muster::test
