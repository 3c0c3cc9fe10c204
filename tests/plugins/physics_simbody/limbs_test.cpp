// Limbs on hinges, sliders and balls: swinging, stops and carried motion.
#include "limbs.hpp"

#include "limbed.hpp"
#include "motion.hpp"

namespace muster::simbody {
namespace {

constexpr double pi = 3.14159265358979323846;

// A body of a thousand tons on four smooth feet, 2 cm under its frame; its limbs hardly shake it.
Robot stand() {
  Robot robot;
  robot.name = "stand";
  description::Link body{"body", {1e6, {0, 0, 0.2}, 1e6 * Matrix3d::Identity()}, {}};
  for (const double x : {-1, 1}) {
    for (const double y : {-1, 1})
      body.shapes.push_back({Eigen::Isometry3d(Eigen::Translation3d(x, y, 0.03)), description::Sphere{0.05}});
  }
  robot.links.push_back(body);
  robot.quadrotor = hummingbird().quadrotor;
  return robot;
}
// Settled on them.
RobotState standing() {
  static const double height = [] {
    RobotState s = at_rest(0, 0, 0);
    s.pose[2] = 0.02;
    const Robot robot = stand();
    Fleet run({s}, robot);
    for (int k = 0; k < 200; ++k) run.tick(0.001, {Command{}});
    return run.states[0].pose[2];
  }();
  RobotState s = at_rest(0, 0, 0);
  s.pose[2] = height;
  return s;
}

// A bob below its joint, longer than wide; its moments about the joint across and along its own axis.
constexpr double mass = 0.1, arm = 0.3, across = 4e-4, along = 1e-4;
constexpr double swing_inertia = across + mass * arm * arm;
const description::Mass bob{mass, {0, 0, -arm}, Vector3d(across, across, along).asDiagonal()};

Eigen::Quaterniond turn_of(const Limb& limb) { return {limb.qw, limb.qx, limb.qy, limb.qz}; }
Vector3d hangs_to(const Limb& limb) { return turn_of(limb) * Vector3d(0, 0, -1); }
class OnABall {
 public:
  OnABall(double deflection, const Vector3d& spin, double step, double damping = 0) : robot_(stand()) {
    hang(robot_, JointKind::ball, {0, 0, 1}, bob).damping = damping;
    RobotState start = standing();
    turn(start.limbs.limb[0], Eigen::Quaterniond(Eigen::AngleAxisd(deflection, Vector3d::UnitY())));
    start.limbs.limb[0].wx = spin.x(), start.limbs.limb[0].wy = spin.y(), start.limbs.limb[0].wz = spin.z();
    fleet_ = std::make_unique<Fleet>(std::vector<RobotState>{start}, robot_, Integrator::midpoint, step);
    step_ = step;
  }
  void tick() { fleet_->tick(step_, {Command{}}); }
  const Limb& limb() const { return fleet_->states[0].limbs.limb[0]; }
  const RobotState& state() const { return fleet_->states[0]; }

 private:
  Robot robot_;
  std::unique_ptr<Fleet> fleet_;
  double step_;
};

// In a circle at a constant deflection gravity's moment turns the angular momentum.
TEST(Limbs, ConicalPendulumTakesItsPeriod) {
  for (const double deflection : {0.05, 0.6, 1.2}) {
    const double rate = std::sqrt(mass * gravity * arm / ((swing_inertia - along) * std::cos(deflection)));
    constexpr int turns = 10, steps = 1000;
    OnABall run(deflection, rate * Vector3d::UnitZ(), 2 * pi / rate / steps);
    double off = 0;
    for (int k = 0; k < turns * steps; ++k) {
      run.tick();
      off = std::max(off, std::abs(std::cos(deflection) + hangs_to(run.limb()).z()));
    }
    const Vector3d start = Vector3d(-std::sin(deflection), 0, 0), end = hangs_to(run.limb());
    EXPECT_NEAR(std::atan2(start.x() * end.y(), start.x() * end.x()) / (2 * pi * turns), 0, 1e-5) << deflection;
    EXPECT_LT(off, 5e-6) << deflection;
  }
}

TEST(Limbs, PlanePendulumTakesItsPeriod) {
  for (const double amplitude : {0.01, 1.0, 2.5}) {
    constexpr double h = 0.001;
    OnABall run(amplitude, Vector3d::Zero(), h);
    std::vector<double> passes;
    double before = hangs_to(run.limb()).x();
    for (int k = 1; k < 6000; ++k) {
      run.tick();
      const double now = hangs_to(run.limb()).x();
      if (before < 0 && now >= 0) passes.push_back(h * (k - now / (now - before)));
      before = now;
    }
    ASSERT_GT(passes.size(), 2u);
    const double period =
        4 * std::sqrt(swing_inertia / (mass * gravity * arm)) * std::comp_ellint_1(std::sin(amplitude / 2));
    EXPECT_NEAR((passes.back() - passes.front()) / static_cast<double>(passes.size() - 1), period, 5e-6 * period)
        << amplitude;
  }
}

// Around and up and down, with a spin about its own axis, for 30 s.
TEST(Limbs, SphericalPendulumKeepsEnergyAndAngularMomentum) {
  constexpr double h = 0.001;
  const Vector3d spin(0.5, -1, 3);
  OnABall run(0.8, spin, h);
  const auto momentum = [](const Eigen::Quaterniond& q, const Vector3d& w) {
    return Vector3d(q * (Vector3d(swing_inertia, swing_inertia, along).asDiagonal() * (q.conjugate() * w)));
  };
  const auto energy = [&](const Eigen::Quaterniond& q, const Vector3d& w) {
    return 0.5 * w.dot(momentum(q, w)) + mass * gravity * arm * (1 + (q * Vector3d(0, 0, -1)).z());
  };
  Eigen::Quaterniond q = turn_of(run.limb());
  const double first_energy = energy(q, spin), first_momentum = momentum(q, spin).z();
  double off_energy = 0, off_momentum = 0, highest = -1, lowest = 1;
  for (int k = 0; k < 30000; ++k) {
    run.tick();
    const Eigen::Quaterniond now = turn_of(run.limb()), half = q.slerp(0.5, now);  // at the time of the velocities
    const Vector3d w(run.limb().wx, run.limb().wy, run.limb().wz);
    off_energy = std::max(off_energy, std::abs(energy(half, w) / first_energy - 1));
    off_momentum = std::max(off_momentum, std::abs(momentum(half, w).z() / first_momentum - 1));
    q = now;
    highest = std::max(highest, hangs_to(run.limb()).z()), lowest = std::min(lowest, hangs_to(run.limb()).z());
  }
  EXPECT_LT(off_energy, 1e-4);
  EXPECT_LT(off_momentum, 1e-5);
  EXPECT_GT(highest - lowest, 0.2);
}

TEST(Limbs, DampingTakesWhatItShould) {
  constexpr double damping = 2e-3, h = 0.001, amplitude = 0.005;
  OnABall run(amplitude, Vector3d::Zero(), h, damping);
  double most = 0;
  const double rate = std::sqrt(mass * gravity * arm / swing_inertia), decay = damping / (2 * swing_inertia);
  const double own = std::sqrt(rate * rate - decay * decay);
  for (int k = 1; k <= 3000; ++k) {
    run.tick();
    const double t = k * h;
    const double expected = amplitude * std::exp(-decay * t) * (std::cos(own * t) + decay / own * std::sin(own * t));
    most = std::max(most, std::abs(-hangs_to(run.limb()).x() - expected));
  }
  EXPECT_LT(most, 1e-4 * amplitude);
  EXPECT_GT(decay * 3, 0.2);
}

// A carriage on a rail that falls onto its stop, and one that its friction holds.
TEST(Limbs, StopsAtLimitsAndSticksByFriction) {
  Robot robot = stand();
  const description::Mass carriage{2, {0, 0, 0}, 0.01 * Matrix3d::Identity()};
  for (const double friction : {0.0, 15.0, 25.0}) {
    description::Joint& rail = hang(robot, JointKind::prismatic, {0, 0, 1}, carriage);
    rail.axis = Vector3d::UnitZ();
    rail.lower = -0.1, rail.upper = 0.1;
    rail.friction = friction;
  }
  Fleet run({standing()}, robot);
  const auto way = [&](int limb) { return run.states[0].limbs.limb[limb].way; };
  for (int k = 0; k < 100; ++k) run.tick(0.001, {Command{}});
  EXPECT_NEAR(way(0), -gravity / 2 * 0.01, 2e-5);
  EXPECT_NEAR(way(1), -(gravity - 15.0 / 2) / 2 * 0.01, 2e-5);
  double lowest = 0;
  for (int k = 0; k < 1000; ++k) {
    run.tick(0.001, {Command{}});
    lowest = std::min(lowest, way(0));
  }
  EXPECT_NEAR(lowest, -0.1, 1e-8);
  EXPECT_NEAR(way(0), -0.1, 1e-8);
  EXPECT_NEAR(way(1), -0.1, 1e-8);
  EXPECT_NEAR(way(2), 0, 1e-6);
}

// A Scarab that drives with an arm on its back.
TEST(Limbs, ADriveWithLimbsAgreesWithRungeKutta) {
  Robot robot = tree(scarab(), false);
  for (auto& joint : robot.joints) joint.damping *= joint.kind != JointKind::ball;
  const auto end_of = [&](Integrator integrator, double step) {
    Fleet run({rolling(0, 0, 0, 0.25, 0)}, robot, integrator, step);
    run.drive(1, 0.01, [](double t) { return command(0.25 + 0.15 * std::sin(1.3 * t), 0.8 * std::sin(0.9 * t)); });
    return run.states[0];
  };
  const RobotState reference = end_of(Integrator::rk3, 0.002), mine = end_of(Integrator::midpoint, 0.001);
  EXPECT_LT(std::hypot(mine.pose[0] - reference.pose[0], mine.pose[1] - reference.pose[1]), 2e-4);
  EXPECT_NEAR(mine.limbs.limb[0].angle, reference.limbs.limb[0].angle, 2e-3);
  EXPECT_LT(turn_of(mine.limbs.limb[1]).angularDistance(turn_of(reference.limbs.limb[1])), 2e-3);
  EXPECT_GT(std::abs(reference.limbs.limb[0].angle), 0.1);
}

// Velocity of a place on each limb, against its motion in a microsecond.
TEST(Limbs, ColumnsAreWhatUnknownsMove) {
  const RobotModel model(tree(hummingbird(), true));
  Limbs limbs;
  limbs.limb[0].angle = 0.7, limbs.limb[2].way = 0.05, limbs.limb[3].angle = -0.4;
  turn(limbs.limb[1], Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5));
  const Posture before = posture_of(model, limbs, Matrix3d::Identity());
  constexpr double h = 1e-6;
  const Vector3d on_limb(0.1, -0.2, 0.3);
  for (int k = 0; k < unknowns_with_legs; ++k) {
    VelocityOf<unknowns_with_legs> u = VelocityOf<unknowns_with_legs>::Zero();
    u[k] = 1;
    const Vector3d turn = h * u.head<3>(), way = h * u.segment<3>(3);
    const Matrix3d body = Eigen::AngleAxisd(turn.norm(), k < 3 ? turn.normalized() : Vector3d::UnitX()).matrix();
    Posture after = before;
    Limbs then = limbs;
    move_limbs(model, h, body, u, after, then);
    for (int i = 0; i < 4; ++i) {
      const Vector3d place = before.limb[i].at + before.limb[i].turned * on_limb;
      const LimbColumns columns = columns_at(model, before, i, place);
      const Vector3d gone = way + after.limb[i].at + after.limb[i].turned * on_limb - place;
      EXPECT_LT((gone / h - columns.going * u).norm(), 1e-5) << i << ' ' << k;
      const Eigen::AngleAxisd turned(after.limb[i].turned * before.limb[i].turned.transpose());
      EXPECT_LT((turned.angle() / h * turned.axis() - columns.turning * u).norm(), 1e-5) << i << ' ' << k;
    }
  }
}

// In any posture and motion of limbs, their collision parts are within the sphere of the neighbour search, and none
// exceeds the speed by which steps are divided.
TEST(Limbs, NoPartIsFartherOrFasterThanTheModelSays) {
  Robot robot = tree(hummingbird(), true);
  robot.links.back().shapes.push_back({Eigen::Isometry3d(Eigen::Translation3d(0, 0.2, 0)), description::Sphere{0.05}});
  robot.links[robot.links.size() - 2].shapes.push_back({Eigen::Isometry3d::Identity(), description::Sphere{0.02}});
  robot.joints[robot.joints.size() - 2].lower = -0.4, robot.joints[robot.joints.size() - 2].upper = 0.6;
  const RobotModel model(robot);
  ASSERT_TRUE(model.feels_limbs());
  double farthest = 0, fastest = 0;  // as shares of the model's values
  for (int k = 0; k < 2000; ++k) {
    const auto any = [k](int what, double low, double high) {
      return low + (high - low) * (0.5 + 0.5 * std::sin(1.7 * k * (what + 1) + what));
    };
    RobotState s = at_rest(0, 0, 0);
    Limb* const limb = s.limbs.limb;
    limb[0].angle = any(0, -pi, pi), limb[2].way = any(1, -0.4, 0.6), limb[3].angle = any(2, -pi, pi);
    turn(limb[1], Eigen::Quaterniond(any(3, -1, 1), any(4, -1, 1), any(5, -1, 1), any(6, -1, 1)).normalized());
    limb[0].rate = any(7, -3, 3), limb[2].speed = any(8, -2, 2), limb[3].rate = any(9, -3, 3);
    limb[1].wx = any(10, -3, 3), limb[1].wy = any(11, -3, 3), limb[1].wz = any(12, -3, 3);
    const Posture posture = posture_of(model, s.limbs, Matrix3d::Identity());
    VelocityOf<unknowns_with_legs> u = VelocityOf<unknowns_with_legs>::Zero();
    take_rates(model, posture, s.limbs, u);
    for (const Part& part : model.parts) {
      if (part.limb < 0) continue;
      const Posture::Place& at = posture.limb[part.limb];
      const Vector3d centre = at.at + at.turned * part.solid.centre;
      const LimbColumns columns = columns_at(model, posture, part.limb, centre);
      farthest = std::max(farthest, ((centre - model.middle).norm() + part.solid.reach()) / model.reach);
      fastest = std::max(fastest, ((columns.going * u).norm() + part.solid.reach() * (columns.turning * u).norm()) /
                                      speed_of(model, s));
    }
  }
  EXPECT_LE(farthest, 1);
  EXPECT_GT(farthest, 0.5);
  EXPECT_LE(fastest, 1);
  EXPECT_GT(fastest, 0.2);
}

TEST(Limbs, ASliderReachesAsFarAsItGoes) {
  Robot robot = hummingbird();
  hang(robot, JointKind::prismatic, {0, 0, 0.1}, bob).axis = Vector3d::UnitX();
  robot.joints.back().lower = -2, robot.joints.back().upper = 3;
  robot.links.back().shapes.push_back({Eigen::Isometry3d::Identity(), description::Sphere{0.05}});
  const RobotModel model(robot);
  EXPECT_GE(model.reach, (Vector3d(3, 0, 0.1) - model.middle).norm() + 0.05);
}

TEST(Limbs, RemadeEngineAndNeighboursChangeNoBit) {
  const Robot robot = tree(scarab(), false);
  const RobotState start = rolling(0, 0, 0.3, 0.3, 0);
  const auto wild = [](int k) { return command(0.3 + 0.2 * std::sin(0.02 * k), std::sin(0.03 * k)); };
  Fleet straight({start}, robot), remade({start}, robot), beside({start, rolling(9, 9, 1, 0.2, 0)}, robot);
  for (int k = 0; k < 60; ++k) {
    straight.tick(0.01, {wild(k)});
    if (k % 7 == 3) remade.remake();
    remade.tick(0.01, {wild(k)});
    beside.tick(0.01, {wild(k), command(0.2, 1)});
  }
  for (const Fleet* other : {&remade, &beside}) {
    expect_same_bits(straight.states[0], other->states[0]);
    EXPECT_EQ(0, std::memcmp(&straight.states[0].limbs, &other->states[0].limbs, sizeof(Limbs)));
  }
  EXPECT_NE(straight.states[0].limbs.limb[0].angle, 0);
}

// Both have twelve unknowns, and touch.
TEST(Limbs, RobotsWithLimbsPushEachOther) {
  const Robot robot = tree(scarab(), false);
  Fleet run({rolling(0, 0, 0, 0.2, 0), rolling(0.4, 0.01, pi, 0.2, 0)}, robot);
  for (int k = 0; k < 200; ++k) run.tick(0.01, {command(0.2, 0), command(0.2, 0)});
  const auto& a = run.states[0].pose;
  const auto& b = run.states[1].pose;
  EXPECT_GT(std::hypot(a[0] - b[0], a[1] - b[1]), 0.15);
  EXPECT_LT(std::hypot(a[0] - b[0], a[1] - b[1]), 0.3);
}

// Dropped with a bob on a ball: it leaves the ground as without it, except for the bob's momentum.
TEST(Limbs, ARobotWithLimbsBounces) {
  Robot robot = hummingbird();
  robot.restitution = 0.5;
  hang(robot, JointKind::ball, {0, 0, 0.2}, {1e-3, {0.1, 0, 0}, 1e-5 * Matrix3d::Identity()});
  RobotState start = at_rest(0, 0, 0);
  start.pose[2] = 0.06 + 0.5;
  Fleet run({start}, robot);
  double lowest = 1, highest = 0;
  for (int k = 0; k < 530; ++k) {
    run.tick(0.001, {Command{}});
    const double height = run.states[0].pose[2] - 0.06;
    if (height < lowest && highest == 0) lowest = height;
    if (k > 330) highest = std::max(highest, height);
  }
  EXPECT_NEAR(lowest, 0, 1e-3);
  EXPECT_NEAR(highest, 0.125, 2e-3);
}

TEST(Limbs, WhatItCannotHoldIsRefused) {
  const auto message = [](const std::function<void(Robot&)>& change) -> std::string {
    Robot robot = hummingbird();
    hang(robot, JointKind::ball, {0, 0, 0}, bob);
    change(robot);
    try {
      RobotModel model(robot);
    } catch (const std::runtime_error& error) {
      const std::string text = error.what();
      return text.substr(text.find("simbody: ") + 9);
    }
    return "";
  };
  const std::string joint = "joint 'limb5_joint' (";
  EXPECT_EQ(message([](Robot&) {}), "");
  EXPECT_EQ(message([](Robot& r) { r.joints.back().friction = 1; }),
            joint + "ball) without a motor has a friction; a damping is modelled");
  EXPECT_EQ(message([](Robot& r) { r.joints.back().kind = JointKind::planar; }),
            joint + "planar) without a motor is no hinge, slider or ball");
  EXPECT_EQ(message([](Robot& r) {
              r.joints.back().kind = JointKind::revolute;
              r.joints.back().lower = 0.1;
            }),
            joint + "revolute) without a motor does not have 0 within its limits");
  EXPECT_EQ(
      message([](Robot& r) {
        for (int k = 0; k < 2; ++k) hang(r, JointKind::ball, {0, 0, 0}, bob);
      }),
      "its joints without motors have 9 rates; expected at most 4 joints, of 4 rates beside wheels and of 6 beside "
      "rotors");
}

}  // namespace
}  // namespace muster::simbody
