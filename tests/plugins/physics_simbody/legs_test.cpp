// Legs: their dynamics are Simbody's, their contact geometry is exact, their springs and motors follow their laws.
#include <random>

#include "robot_models.hpp"
#include "walkers.hpp"

namespace muster::simbody {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

class Legs : public testing::Test {
 protected:
  double draw() { return static_cast<double>(random_()) / 2147483648.0 - 1; }
  Vector3d draw_vector() { return {draw(), draw(), draw()}; }
  Eigen::Quaterniond draw_turn() { return Eigen::Quaterniond(draw(), draw(), draw(), draw()).normalized(); }

  const RobotModel model_{rdk()};
  std::mt19937 random_{7};
};

TEST_F(Legs, DynamicsAreSimbodys) {
  constexpr int n = unknowns_with_legs;
  const RobotModels crew({{"r", &rdk()}});
  for (int trial = 0; trial < 20; ++trial) {
    SimTK::State state = crew.system().state;
    const Eigen::Quaterniond q = draw_turn();
    const double values[] = {q.w(), q.x(), q.y(), q.z(), draw(), draw(), draw()};
    for (int k = 0; k < 7; ++k) state.updQ()[k] = values[k];
    LegAngles angle;
    for (int k = 0; k < 6; ++k) state.updQ()[7 + k] = angle[k] = 3 * draw();
    for (int k = 0; k < n; ++k) state.updU()[k] = 5 * draw();
    crew.system().system.realize(state, SimTK::Stage::Acceleration);
    const Matrix3d r = q.toRotationMatrix();
    const auto in_body = [&](const SimTK::Vector& v) {
      VelocityOf<n> result = Eigen::Map<const VelocityOf<n>>(&v[0]);
      result.head<3>() = (r.transpose() * result.head<3>()).eval();
      result.segment<3>(3) = (r.transpose() * result.segment<3>(3)).eval();
      return result;
    };
    const LeggedMass mine = weigh(model_, angle, in_body(state.getU()), r.transpose() * Vector3d(0, 0, -gravity));
    SimTK::Vector column, unit(n, 0.0);
    for (int k = 0; k < n; ++k) unit[k] = draw();
    crew.system().matter.multiplyByM(state, unit, column);
    EXPECT_LT((mine.mass * in_body(unit) - in_body(column)).norm(), 1e-9 * in_body(column).norm());
    const VelocityOf<n> expected = in_body(state.getUDot()), found = inverse(mine.mass) * mine.force;
    EXPECT_LT((found - expected).norm(), 1e-9 * expected.norm()) << found.transpose() << "\n" << expected.transpose();
  }
}

TEST_F(Legs, NearestToABoxIsFound) {
  constexpr double margin = 0.005;
  int met = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const Matrix3d leg = draw_turn().toRotationMatrix(), turned = draw_turn().toRotationMatrix();
    const Solid box{Solid::Kind::box, 0.1 * draw_vector(), turned, {0.03, 0.05, 0.02}};
    const Vector3d hip = 0.1 * draw_vector();
    double least = 1e9;
    for (int k = 0; k <= 5000; ++k) {
      const double way = 3.14159265358979 * k / 5000;
      const Vector3d p = hip - 0.06 * (std::sin(way) * leg.col(0) + (1 - std::cos(way)) * leg.col(2));
      const Touch t = touch({Solid::Kind::sphere, p, Matrix3d::Identity(), Vector3d::Zero()}, box, 1);
      least = std::min(least, t.points[0].gap);
    }
    const LegTouches found = touch_leg(hip, leg.col(0), leg.col(2), 0.06, box, margin);
    if (least > margin) continue;
    ++met;
    ASSERT_GT(found.count, 0) << least;
    const double mine =
        found.count == 1 ? found.touch[0].point.gap : std::min(found.touch[0].point.gap, found.touch[1].point.gap);
    EXPECT_LT(mine, least + 1e-6);
    EXPECT_GT(mine, least - 1e-4);  // the search above misses some of them
  }
  EXPECT_GT(met, 80);
}

// Six springs carry the weight.
TEST_F(Legs, SinkByTheirSprings) {
  Fleet fleet({at_rest(0, 0, 0)}, rdk(), Integrator::midpoint, 0.002);
  for (int k = 0; k < 200; ++k) fleet.tick(0.01, {Command{}});
  const double weight = gravity * whole_mass(rdk()).mass;
  EXPECT_NEAR(fleet.states[0].pose[2], -weight / (6 * 2000), 0.01 * weight / 12000);
  EXPECT_LT(std::abs(fleet.states[0].pose[0]), 1e-3);
}

TEST_F(Legs, MotorsGiveNoMoreThanTheirTorque) {
  description::Robot weak = rdk();
  weak.legs->max_torque = 1;
  Fleet fleet({at_rest(0, 0, 0)}, weak, Integrator::midpoint, 0.002);
  double most = 0;
  walk(fleet, {1}, 0, 3, 0.01, [&](double) {
    for (const double torque : fleet.states[0].leg_torque) most = std::max(most, std::abs(torque));
  });
  EXPECT_DOUBLE_EQ(most, 1);
  EXPECT_GT(fleet.states[0].pose[0], 0.2);  // slower, but it walks
}

// The controller's law in a leg that swings freely: torque = gains times errors, both at mid-step.
TEST_F(Legs, MotorIsAController) {
  const auto& drive = *rdk().legs;
  const double h = 0.001, angle = 0.3, rate = 2, asked = 0.31, asked_rate = 5;
  const Motor motor = leg_motor(drive, asked + whole_turn, asked_rate, angle, h);
  const double torque = drive.position_gain * (asked - angle - h / 2 * rate) + drive.rate_gain * (asked_rate - rate);
  EXPECT_NEAR(motor.impulse(rate) / h, torque, 1e-9);
  EXPECT_NEAR(motor.impulse(-1e3) / h, drive.max_torque, 1e-12);
}

// Free fall with legs driven around: the robot conserves its momenta.
TEST_F(Legs, MomentumIsKeptInTheAir) {
  const auto angular = [&](double h) {
    RobotState s = at_rest(0, 0, 0);
    s.pose[2] = 10;
    s.twist = {0.3, -0.2, 4, 1, 0.5, -0.7};
    Fleet fleet({s}, rdk(), Integrator::midpoint, h);
    const auto momentum = [&] {
      const RobotState& now = fleet.states[0];
      const Matrix3d r = Eigen::Quaterniond(now.pose[3], now.pose[4], now.pose[5], now.pose[6]).toRotationMatrix();
      VelocityOf<unknowns_with_legs> u;
      u.head<3>() = r.transpose() * Vector3d(now.twist[3], now.twist[4], now.twist[5]);
      u.segment<3>(3) = r.transpose() * Vector3d(now.twist[0], now.twist[1], now.twist[2]);
      for (int k = 0; k < 6; ++k) u[6 + k] = now.leg_rate[k];
      LegAngles angle;  // at the time of the velocities
      for (int k = 0; k < 6; ++k) angle[k] = now.leg_angle[k] - h / 2 * now.leg_rate[k];
      const Matrix3d half = Eigen::AngleAxisd(h / 2 * u.head<3>().norm(), u.head<3>().normalized()).toRotationMatrix();
      const LeggedMass legged = weigh(model_, angle, u, Vector3d::Zero());
      const VelocityOf<unknowns_with_legs> p = legged.mass * u;
      // About the mass centre, in the world.
      const double m = legged.mass(3, 3);
      const Vector3d centre(legged.mass(2, 4) / m, legged.mass(0, 5) / m, legged.mass(1, 3) / m);
      return Vector3d(r * half.transpose() * (p.head<3>() - centre.cross(p.segment<3>(3).eval())));
    };
    Vector3d first = Vector3d::Zero();
    double most = 0;
    walk(fleet, {2}, 0, 0.6, 0.01, [&](double t) {
      if (t < 0.015) first = momentum();
      most = std::max(most, (momentum() - first).norm() / first.norm());
    });
    return most;
  };
  const double coarse = angular(0.002), fine = angular(0.001);
  EXPECT_LT(fine, 0.02);
  EXPECT_NEAR(coarse / fine, 2, 0.5);  // gyroscopic terms are explicit: of first order, as of wheels and boxes
}

// Limp legs, dropped: springs, dampers, impacts and friction only dissipate energy.
TEST_F(Legs, EnergyIsOnlyLost) {
  description::Robot limp = rdk();
  limp.legs->max_torque = 1e-12;
  RobotState s = at_rest(0, 0, 0);
  s.pose[2] = 0.05;
  Fleet fleet({s}, limp, Integrator::midpoint, 0.001);
  const auto energy = [&] {
    const RobotState& now = fleet.states[0];
    const Matrix3d r = Eigen::Quaterniond(now.pose[3], now.pose[4], now.pose[5], now.pose[6]).toRotationMatrix();
    VelocityOf<unknowns_with_legs> u;
    u.head<3>() = r.transpose() * Vector3d(now.twist[3], now.twist[4], now.twist[5]);
    u.segment<3>(3) = r.transpose() * Vector3d(now.twist[0], now.twist[1], now.twist[2]);
    for (int k = 0; k < 6; ++k) u[6 + k] = now.leg_rate[k];
    const LeggedMass legged = weigh(model_, now.leg_angle, u, Vector3d(0, 0, -gravity));
    double height = model_.body.mass * (r * model_.body.centre).z();
    double spring = 0;
    for (std::size_t k = 0; k < 6; ++k) {
      const Leg& leg = model_.legs[k];
      const Eigen::AngleAxisd turned(now.leg_angle[k], Vector3d::UnitY());
      height += leg.mass.mass * (r * (leg.hip + turned * leg.mass.centre)).z();
      spring += 1000 * std::pow(std::min(0.0, foot_height(now, k, model_)), 2);
    }
    return 0.5 * u.dot(legged.mass * u) + gravity * (height + 2.7 * now.pose[2]) + spring;
  };
  const double start = energy();
  double least = start, gain = 0;
  for (int k = 0; k < 200; ++k) {
    fleet.tick(0.005, {Command{}});
    gain = std::max(gain, energy() - least);
    least = std::min(least, energy());
  }
  EXPECT_LT(gain, 0.01 * (start - least));
  EXPECT_GT(start - least, 2.7 * gravity * 0.05);  // it lies on the ground
}

TEST_F(Legs, AreNoWheelsForSimbodysIntegrators) {
  try {
    make_engine({{"walker", &rdk()}}, Integrator::rk3, 0.001);
    FAIL() << "it was taken";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "robot 'walker' walks; Simbody's own integrators roll on wheels: use midpoint");
  }
}

}  // namespace
}  // namespace muster::simbody
