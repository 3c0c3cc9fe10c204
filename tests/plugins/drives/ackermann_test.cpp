// Cars: Ackermann's geometry in closed form, and its circles on each backend.
#include "driven.hpp"

namespace muster::test {
namespace {

const description::Robot& car() {
  static const description::Robot robot = description::read_robot(models + "f1tenth.urdf");
  return robot;
}
const description::Steering& steering() { return *car().drive->steering; }

TEST(F1Tenth, HasItsSourcesFigures) {
  EXPECT_TRUE(car().warnings.empty());
  const description::Mass whole = whole_mass(car());
  EXPECT_NEAR(whole.mass, 3.74, 1e-6);
  EXPECT_NEAR(whole.centre.x(), 0.17145, 1e-6);
  EXPECT_NEAR(whole.centre.z(), 0.074, 1e-6);
  EXPECT_NEAR(whole.inertia(2, 2), 0.04712, 1e-6);
  EXPECT_NEAR(steering().wheelbase, 0.15875 + 0.17145, 1e-12);
  EXPECT_TRUE(limbs_of(car()).empty()) << "its kingpins are not loose";
}

// The axles of all wheels meet in one point: cot(outer) - cot(inner) = width / wheelbase, and the mean of the
// cotangents is that of the steering angle.
TEST(Ackermann, WheelsHaveTheAnglesOfOneCentre) {
  for (const double angle : {0.05, 0.2, 0.4, -0.3}) {
    const double left = steering().of_wheel(0, angle), right = steering().of_wheel(1, angle);
    EXPECT_NEAR(1 / std::tan(right) - 1 / std::tan(left), steering().kingpin_width / steering().wheelbase, 1e-12);
    EXPECT_NEAR((1 / std::tan(right) + 1 / std::tan(left)) / 2, 1 / std::tan(angle), 1e-9);
    EXPECT_GT(std::abs(angle > 0 ? left : right), std::abs(angle > 0 ? right : left)) << "the inner one turns more";
    const Eigen::Vector3d centre(0, steering().wheelbase / std::tan(angle), 0);
    for (int side = 0; side < 2; ++side) {
      const Eigen::Vector3d to_centre = centre - steering().middle(side, angle), axle = steering().axle(side, angle);
      EXPECT_NEAR(to_centre.x() * axle.y() - to_centre.y() * axle.x(), 0, 1e-12);
    }
  }
  EXPECT_EQ(steering().of_wheel(0, 0), 0);
}

class Cars : public testing::TestWithParam<const char*> {
 protected:
  const Folder folder;
};
INSTANTIATE_TEST_SUITE_P(Backends, Cars, testing::ValuesIn(backends), name_of);

std::string steady(double v, double angle) {
  return "<control.steady robot=\"r\" v=\"" + std::to_string(v) + "\" w=\"" +
         std::to_string(steering().turn(v, angle)) + "\"/>";
}

// Radius of the circle through three places.
double radius_of(const Pose& a, const Pose& b, const Pose& c) {
  const double ab = std::hypot(b.x - a.x, b.y - a.y), bc = std::hypot(c.x - b.x, c.y - b.y),
               ca = std::hypot(a.x - c.x, a.y - c.y);
  const double twice_area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  return ab * bc * ca / (2 * std::abs(twice_area));
}

// At 0.3 m/s tyres hardly slip.
TEST_P(Cars, DriveCirclesOfWheelbaseOverTangent) {
  const double tolerance = std::string(GetParam()) == "physics.planar" ? 1e-5 : 2e-3;
  for (const double angle : {0.4, 0.2, -0.3}) {
    for (const double v : {0.3, -0.3}) {
      Simulation run = driven(folder, "f1tenth", GetParam(), steady(v, angle));
      run_to(run, 2);
      const Pose a = row<Pose>(run, "robot/r/pose");
      run_to(run, 4);
      const Pose b = row<Pose>(run, "robot/r/pose");
      run_to(run, 6);
      const Pose c = row<Pose>(run, "robot/r/pose");
      const double expected = steering().wheelbase / std::abs(std::tan(angle)), radius = radius_of(a, b, c);
      std::printf("[ measured ] steering %.1f rad at %.1f m/s: radius %.5f m, expected %.5f\n", angle, v, radius,
                  expected);
      EXPECT_NEAR(radius, expected, tolerance * expected);
      const double turned = std::remainder(yaw_of(c) - yaw_of(b), 2 * M_PI);
      EXPECT_NEAR(turned, 2 * steering().turn(v, angle), 2 * tolerance);
    }
  }
}

TEST_P(Cars, DriveStraightAndKeepTheirHeading) {
  Simulation run = driven(folder, "f1tenth", GetParam(), "<control.steady robot=\"r\" v=\"1\" w=\"0\"/>");
  run_to(run, 3);
  const Pose p = row<Pose>(run, "robot/r/pose");
  EXPECT_NEAR(p.x, 3 - 0.08, 0.04);  // less half of the ramp, which the grip of the rear axle limits, and a tick
  EXPECT_NEAR(p.y, 0, 1e-6);
  EXPECT_NEAR(yaw_of(p), 0, 1e-6);
  EXPECT_NEAR(p.z, 0, 2e-4) << "its wheels stand on the ground";
}

// Friction holds at most friction m g: a car that is asked for more at speed drifts outwards.
TEST_P(Cars, SlideWhereTheTurnNeedsMoreThanFriction) {
  if (std::string(GetParam()) == "physics.planar") GTEST_SKIP() << "planar has ideal wheels";
  const std::string slippery = model_with(folder, "f1tenth", {{"friction=\"1.0489\"", "friction=\"0.2\""}});
  Simulation run = driven(folder, slippery, GetParam(), steady(2.5, 0.35));  // 6.9 m/s2 of at most 1.96
  run_to(run, 3);
  Pose before = row<Pose>(run, "robot/r/pose");
  double most = 0, last_vx = row<Twist>(run, "robot/r/twist").vx, last_vy = row<Twist>(run, "robot/r/twist").vy;
  for (int k = 0; k < 100; ++k) {
    run.step();
    const Twist t = row<Twist>(run, "robot/r/twist");
    const Pose p = row<Pose>(run, "robot/r/pose");
    const double c = std::cos(yaw_of(p)), s = std::sin(yaw_of(p)), lead = 0.17145;
    const double vx = t.vx - t.wz * lead * s, vy = t.vy + t.wz * lead * c;  // of the centre of mass
    if (k > 0) most = std::max(most, std::hypot(vx - last_vx, vy - last_vy) / 0.01);
    last_vx = vx, last_vy = vy;
  }
  const Pose after = row<Pose>(run, "robot/r/pose");
  EXPECT_GT(std::hypot(after.x - before.x, after.y - before.y), 0.05);
  std::printf("[ measured ] greatest acceleration %.3f m/s2 of %.3f\n", most, 0.2 * 9.81);
  EXPECT_LT(most, 0.2 * 9.81 * (std::string(GetParam()) == "physics.ode" ? 1.45 : 1.05));
  EXPECT_GT(most, 0.2 * 9.81 * 0.6) << "the front wheels slide first";
}

TEST_P(Cars, HaveTheSameBitsAfterARestoreAndRemade) {
  expect_same_bits(folder, [&] { return driven(folder, "f1tenth", GetParam(), steady(1.5, 0.3)); });
}

TEST_P(Cars, OdometryFollowsTheRearAxle) {
  Simulation run = driven(folder, "f1tenth", GetParam(), steady(0.5, 0.3) + "<robots.odometry/>");
  run_to(run, 6);
  const auto at = row<Odometry>(run, "robot/r/odometry");
  const Pose p = row<Pose>(run, "robot/r/pose");
  EXPECT_NEAR(std::hypot(at.x - p.x, at.y - p.y), 0,
              std::string(GetParam()) == "physics.planar" ? 1e-4 : 0.02);  // it drifts as it sets out
}

// A frame elsewhere than under the rear axle changes no circle.
TEST_P(Cars, MayHaveTheirFrameInTheMiddle) {
  std::string urdf;
  {
    std::ifstream file(models + "f1tenth.urdf");
    urdf.assign(std::istreambuf_iterator<char>(file), {});
  }
  std::string moved = urdf;
  for (const auto& [was, is] : std::vector<std::pair<std::string, std::string>>{
           {"xyz=\"0 0.13 0.0508\"", "xyz=\"-0.1651 0.13 0.0508\""},
           {"xyz=\"0 -0.13 0.0508\"", "xyz=\"-0.1651 -0.13 0.0508\""},
           {"xyz=\"0.3302 0.13 0.0508\"", "xyz=\"0.1651 0.13 0.0508\""},
           {"xyz=\"0.3302 -0.13 0.0508\"", "xyz=\"0.1651 -0.13 0.0508\""},
           {"xyz=\"0.167391 0 0.0782582\"", "xyz=\"0.002291 0 0.0782582\""},
           {"xyz=\"0.1651 0 0.0782582\"", "xyz=\"0 0 0.0782582\""}}) {
    ASSERT_NE(moved.find(was), std::string::npos) << was;
    moved.replace(moved.find(was), was.size(), is);
  }
  folder.write("middle.urdf", moved);
  Simulation at_axle = driven(folder, "f1tenth", GetParam(), steady(0.5, 0.3) + "<robots.odometry/>");
  run_to(at_axle, 5);
  Simulation in_middle = driven(folder, "middle.urdf", GetParam(), steady(0.5, 0.3) + "<robots.odometry/>");
  run_to(in_middle, 5);
  const Pose a = row<Pose>(at_axle, "robot/r/pose"), b = row<Pose>(in_middle, "robot/r/pose");
  const double yaw = yaw_of(b), ahead = 0.1651;  // the second begins so far behind
  EXPECT_NEAR(yaw, yaw_of(a), 1e-3);
  EXPECT_NEAR(b.x - ahead * std::cos(yaw) + ahead, a.x, 2e-3);
  EXPECT_NEAR(b.y - ahead * std::sin(yaw), a.y, 2e-3);
  const auto o = row<Odometry>(in_middle, "robot/r/odometry");
  EXPECT_NEAR(std::hypot(o.x - b.x, o.y - b.y), 0, 0.02);
}

TEST(Steering, TurnsNoFasterThanItsRateAndHoldsAtRest) {
  Folder folder;
  Simulation run = driven(
      folder, "f1tenth", "physics.planar",
      "<control.steady robot=\"r\" v=\"1\" w=\"" + std::to_string(steering().turn(1, 0.4)) + "\" until=\"0.5\"/>");
  double last = 0;
  for (int k = 0; k < 45; ++k) {
    run.step();
    const auto s = row<SteeringAngle>(run, "robot/r/steering");
    EXPECT_DOUBLE_EQ(s.angle, last) << "begins where the last tick ended";
    EXPECT_LE(std::abs(s.rate), 3.2 + 1e-12);
    last = s.angle + 0.01 * s.rate;
    EXPECT_NEAR(last, std::min(0.4, 3.2 * 0.01 * (k + 1)), 1e-6);
  }
  run_to(run, 2);
  EXPECT_NEAR(row<SteeringAngle>(run, "robot/r/steering").angle, 0.4, 1e-6) << "without a speed it stays";
}

std::vector<std::string> warnings(Simulation& run, double until) {
  run_to(run, until);
  std::vector<std::string> result;
  for (const auto& event : run.events()) {
    if (event.message.find("steering cannot") != std::string::npos) result.push_back(event.message);
  }
  return result;
}

TEST(Steering, WarnsOnceOfACircleOutOfReach) {
  Folder folder;
  Simulation run = driven(folder, "f1tenth", "physics.planar", "<control.steady robot=\"r\" v=\"0.5\" w=\"1\"/>");
  EXPECT_THAT(warnings(run, 3),
              testing::ElementsAre(testing::HasSubstr(
                  "robot 'r' is asked for a circle of radius 0.5 m, which its steering cannot make; its "
                  "smallest circle has a radius of 0.7416 m (wheelbase / tan(steering_limit)); it drives that one")));
  const auto s = row<SteeringAngle>(run, "robot/r/steering");
  EXPECT_NEAR(s.angle, 0.4189, 1e-9);
  EXPECT_NEAR(row<Twist>(run, "robot/r/twist").wz, 0.5 * std::tan(0.4189) / steering().wheelbase, 1e-9);
  Simulation spot = driven(folder, "f1tenth", "physics.planar", "<control.steady robot=\"r\" v=\"0\" w=\"1\"/>");
  EXPECT_THAT(warnings(spot, 1), testing::ElementsAre(testing::HasSubstr("a turn on the spot")));
  Simulation fine = driven(folder, "f1tenth", "physics.planar", steady(0.5, 0.4));
  EXPECT_THAT(warnings(fine, 1), testing::IsEmpty());
}

TEST(Ackermann, FaultsAreNamed) {
  EXPECT_THAT(fault("f1tenth", {{"wheelbase=\"0.3302\"", "wheelbase=\"0.33\""}}),
              testing::HasSubstr("<ackermann> wheelbase=\"0.33\" contradicts the joints: wheel "
                                 "'front_left_wheel_joint' is 0.3302 m before the rear axle"));
  EXPECT_THAT(fault("f1tenth", {{"steering_limit=\"0.4189\"", "steering_limit=\"0.6\""}}),
              testing::HasSubstr("but the <limit> of joint 'left_steering_joint' is 0.55 rad"));
  EXPECT_THAT(fault("f1tenth", {{"steering_limit=\"0.4189\"", "steering_limit=\"1.5\""}}),
              testing::HasSubstr(
                  "is too much: the inner wheel would turn by a quarter turn or more; expected less than 1.196 rad"));
  EXPECT_THAT(fault("f1tenth", {{"kingpin_width=\"0.26\"", "kingpin_width=\"0.2\""}}),
              testing::HasSubstr("is not half a kingpin_width from the body's x axis (left: +y, right: -y): it is at y "
                                 "= 0.13 m, expected 0.1"));
  EXPECT_THAT(fault("f1tenth", {{"wheel_separation=\"0.26\"", "wheel_separation=\"0.3\""}}),
              testing::HasSubstr("is not half a wheel_separation"));
  EXPECT_THAT(fault("f1tenth", {{"left_steering=\"left_steering_joint\"", "left_steering=\"rear_left_wheel_joint\""}}),
              testing::HasSubstr("does not turn about the body's z axis: it cannot steer"));
  EXPECT_THAT(fault("f1tenth", {{"left_steering=\"left_steering_joint\"", "left_steering=\"left_stering_joint\""}}),
              testing::HasSubstr("is not known; did you mean 'left_steering_joint'?"));
}

}  // namespace
}  // namespace muster::test
