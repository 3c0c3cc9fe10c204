// Motion of a Scarab on flat ground, against closed forms.
#include <algorithm>

#include "scarabs.hpp"

namespace muster::simbody {
namespace {

double distance(const RobotState& s, double x, double y) { return std::hypot(s.pose[0] - x, s.pose[1] - y); }

TEST(Motion, ArcHasRadiusOfSpeedOverTurnRate) {
  const double v = 0.3, w = 0.5, until = 8;
  Fleet run({rolling(1, 2, 0.4, v, w)});
  double least = 1e9, most = 0;
  const double cx = 1 - v / w * std::sin(0.4), cy = 2 + v / w * std::cos(0.4);
  for (int k = 0; k < 800; ++k) {
    run.tick(0.01, {command(v, w)});
    const double r = distance(run.states[0], cx, cy);
    least = std::min(least, r);
    most = std::max(most, r);
  }
  EXPECT_NEAR(least, v / w, 1e-3 * v / w);
  EXPECT_NEAR(most, v / w, 1e-3 * v / w);
  const double heading = 0.4 + w * until;
  EXPECT_NEAR(distance(run.states[0], cx + v / w * std::sin(heading), cy - v / w * std::cos(heading)), 0, 1e-4);
}

// Gentle S of speed and turn, without slip: ideal wheels are the reference, by fine quadrature.
struct Course {
  static double v(double t) { return 0.25 + 0.15 * std::sin(1.3 * t); }
  static double w(double t) { return 0.8 * std::sin(0.9 * t); }
  static Command at(double t) { return command(v(t), w(t)); }
  static std::array<double, 3> truth(double until) {
    double x = 0, y = 0, heading = 0;
    const int n = 200000;
    const double h = until / n;
    for (int k = 0; k < n; ++k) {
      const double t = (k + 0.5) * h;
      const double middle = heading + 0.5 * h * w(t - 0.25 * h);
      x += h * v(t) * std::cos(middle);
      y += h * v(t) * std::sin(middle);
      heading += h * w(t);
    }
    return {x, y, heading};
  }
};

RobotState after_course(double h) {
  Fleet run({rolling(0, 0, 0, Course::v(0), 0)}, scarab(), Integrator::midpoint, h);
  run.drive(4, h, Course::at);
  return run.states[0];
}

TEST(Motion, StepperIsOfSecondOrder) {
  const RobotState limit = after_course(0.00125);
  std::vector<double> errors;
  for (double h : {0.04, 0.02, 0.01}) errors.push_back(distance(after_course(h), limit.pose[0], limit.pose[1]));
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2, 0.25) << errors[0] << " " << errors[1];
  EXPECT_NEAR(std::log2(errors[1] / errors[2]), 2, 0.25) << errors[1] << " " << errors[2];
}

// Not quite ideal wheels: the body pitches on its soft contacts in acceleration, by some micrometres along the path.
TEST(Motion, ConvergesToIdealWheels) {
  const auto truth = Course::truth(4);
  EXPECT_LT(distance(after_course(0.00125), truth[0], truth[1]), 2e-5);
  EXPECT_LT(distance(after_course(0.01), truth[0], truth[1]), 4e-5);
}

TEST(Motion, FreeFallIsAParabola) {
  for (double h : {0.01, 0.001}) {
    RobotState high = at_rest(0, 0, 0);
    high.pose[2] = 10;
    high.twist = {1, 2, 3, 0, 0, 0};
    Fleet run({high}, scarab(), Integrator::midpoint, h);
    for (int k = 0; k < 100; ++k) run.tick(0.01, {command(0, 0)});
    EXPECT_NEAR(run.states[0].pose[0], 1, 1e-9);
    EXPECT_NEAR(run.states[0].pose[1], 2, 1e-9);
    EXPECT_NEAR(run.states[0].pose[2], 10 + 3 - 0.5 * gravity, 1e-9) << h;
  }
}

TEST(Motion, TumblingInFlightKeepsMomentum) {
  RobotState high = at_rest(0, 0, 0);
  high.pose[2] = 100;
  high.twist = {0, 0, 0, 1, 2, 3};
  Fleet run({high});
  const description::Mass whole = whole_mass(scarab());
  const auto centre = [&](const RobotState& s) {
    const Eigen::Quaterniond q(s.pose[3], s.pose[4], s.pose[5], s.pose[6]);
    return Eigen::Vector3d(Eigen::Vector3d(s.pose[0], s.pose[1], s.pose[2]) + q * whole.centre);
  };
  const Eigen::Vector3d start = centre(high), w(1, 2, 3);
  const Eigen::Vector3d velocity = w.cross(whole.centre);
  for (int k = 0; k < 100; ++k) run.tick(0.01, {command(0, 0)});
  const Eigen::Vector3d fallen = start + velocity - Eigen::Vector3d(0, 0, 0.5 * gravity);
  EXPECT_LT((centre(run.states[0]) - fallen).norm(), 1e-3);
}

TEST(Motion, StandsStillAtRest) {
  Fleet run({at_rest(3, -2, 1)});
  for (int k = 0; k < 1000; ++k) run.tick(0.01, {command(0, 0)});
  const RobotState& s = run.states[0];
  EXPECT_LT(distance(s, 3, -2), 1e-9);
  EXPECT_NEAR(yaw(s), 1, 1e-9);
  EXPECT_LT(s.pose[2], 0);
  EXPECT_GT(s.pose[2], -1e-4);  // sunk by weight over stiffness
  double kinetic = 0;
  for (double rate : s.twist) kinetic += 0.5 * 8 * rate * rate;
  EXPECT_LT(kinetic, 1e-15);
}

description::Robot changed(const std::function<void(description::DifferentialDrive&)>& change) {
  description::Robot robot = scarab();
  change(*robot.drive);
  return robot;
}

double speed(const RobotState& s) { return std::hypot(s.twist[0], s.twist[1]); }

// Two wheels pull with torque over radius; they also spin up themselves.
TEST(Motion, TorqueLimitCapsAcceleration) {
  const double torque = 0.2;
  const description::Robot weak = changed([&](auto& drive) { drive.max_torque = torque; });
  Fleet run({at_rest(0, 0, 0)}, weak);
  for (int k = 0; k < 50; ++k) run.tick(0.01, {command(10, 0)});
  const double radius = 0.05, wheel_inertia = 0.00025;
  const double expected = 2 * torque / radius / (8 + 2 * wheel_inertia / (radius * radius));
  EXPECT_NEAR(speed(run.states[0]) / 0.5, expected, 0.01 * expected);
}

TEST(Motion, ScarabsOwnTorqueHoldsOnceItRolls) {
  Fleet run({rolling(0, 0, 0, 0.5, 0)});
  for (int k = 0; k < 100; ++k) run.tick(0.01, {command(0.5, 0)});
  EXPECT_NEAR(run.states[0].pose[0], 0.5, 1e-6);
}

// Beyond friction the wheels spin, and the pull is friction times their load. The weight splits between wheels and
// caster by statics with the pull at the ground and the inertia at the centre of mass.
TEST(Motion, SlipsAboveFriction) {
  const double mu = 0.1;
  const description::Robot smooth = changed([&](auto& drive) { drive.friction = mu; });
  Fleet run({at_rest(0, 0, 0)}, smooth);
  for (int k = 0; k < 30; ++k) run.tick(0.01, {command(1, 0)});
  const description::Mass whole = whole_mass(scarab());
  const double b = 0.08, c = -whole.centre.x(), high = whole.centre.z();
  // N_w + N_c = m g;  moments about the contact line of the wheels: N_c b = m g c + m a high;  m a = mu N_w
  const double acceleration = mu * gravity * (b - c) / (b + mu * high);
  EXPECT_NEAR(speed(run.states[0]) / 0.3, acceleration, 0.01 * acceleration);
  EXPECT_GT(run.states[0].rate[0] * 0.05, 2 * speed(run.states[0]));  // the wheels spin
}

// Locked wheels thrown sideways and along stop by the same law in every direction: the cone is round.
TEST(Motion, FrictionConeIsRound) {
  const double mu = 0.1;
  description::Robot sled = changed([&](auto& drive) { drive.friction = mu; });
  for (auto& joint : sled.joints) {  // caster and skid under the centre of mass: no moment in any direction
    if (joint.name == "caster_joint") joint.origin.translation() = Eigen::Vector3d(-0.08, 0, 0.02);
  }
  std::vector<double> way;
  for (double angle : {0.0, 0.7853981633974483, 1.5707963267948966}) {
    RobotState thrown = at_rest(0, 0, 0);
    thrown.twist = {0.3 * std::cos(angle), 0.3 * std::sin(angle), 0, 0, 0, 0};
    Fleet run({thrown}, sled);
    for (int k = 0; k < 10; ++k) run.tick(0.01, {command(0, 0)});
    way.push_back(std::hypot(run.states[0].pose[0], run.states[0].pose[1]));
  }
  EXPECT_NEAR(way[1], 0.5 * (way[0] + way[2]), 0.02 * way[0]) << way[0] << " " << way[1] << " " << way[2];
}

TEST(Motion, GroundAccelerationStaysUnderItsDeclaredBound) {
  const description::Mass whole = whole_mass(scarab());
  Fleet run({at_rest(0, 0, 0)});
  const double bound = max_acceleration(scarab());
  EXPECT_DOUBLE_EQ(bound, 0.8 * 9.81);
  const auto velocity = [&] {
    const RobotState& s = run.states[0];
    const Eigen::Quaterniond q(s.pose[3], s.pose[4], s.pose[5], s.pose[6]);
    const Eigen::Vector3d w(s.twist[3], s.twist[4], s.twist[5]);
    return Eigen::Vector3d(Eigen::Vector3d(s.twist[0], s.twist[1], s.twist[2]) + w.cross(q * whole.centre));
  };
  double most = 0;
  Eigen::Vector3d before = velocity();
  for (int k = 0; k < 100; ++k) {
    run.tick(0.01, {command(1, k < 50 ? 3 : -3)});
    most = std::max(most, (velocity() - before).head<2>().norm() / 0.01);
    before = velocity();
  }
  EXPECT_LE(most, bound * 1.02);
  EXPECT_GT(most, 0.3 * bound);  // the test does drive hard
}

TEST(Motion, DropsOntoItsWheelsAndStands) {
  RobotState high = at_rest(0, 0, 0);
  high.pose[2] = 0.1;
  high.pose[3] = std::cos(0.1), high.pose[4] = std::sin(0.1);  // rolled by 0.2 rad
  Fleet run({high});
  for (int k = 0; k < 300; ++k) run.tick(0.01, {command(0, 0)});
  EXPECT_NEAR(run.states[0].pose[2], 0, 1e-4);
  EXPECT_NEAR(run.states[0].pose[4], 0, 1e-3);
  EXPECT_LT(speed(run.states[0]), 1e-6);
}

TEST(Motion, BlowingUpNamesTheRobot) {
  RobotState mad = at_rest(0, 0, 0);
  mad.twist[0] = 1e6;
  Fleet run({at_rest(5, 5, 0), mad});
  try {
    run.tick(0.01, {command(0, 0), command(0, 0)});
    FAIL() << "nothing was thrown";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "robot 'r1': its motion blew up");
  }
}

}  // namespace
}  // namespace muster::simbody
