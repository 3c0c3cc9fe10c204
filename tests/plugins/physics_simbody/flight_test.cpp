// Robots with rotors: in the air by fourth order, near obstacles by the stepper for contacts.
#include <random>

#include "midpoint_engine.hpp"
#include "scarabs.hpp"

namespace muster::simbody {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Three different moments of inertia, a centre of mass off the origin, and no drag: for conservation in free flight.
description::Robot uneven(double drag_factor) {
  description::Robot robot = hummingbird();
  robot.links[0].mass.inertia = Vector3d(0.004, 0.007, 0.0095).asDiagonal();
  robot.links[0].mass.centre += Vector3d(0.01, -0.02, 0.005);
  robot.quadrotor->drag_factor = drag_factor;
  return robot;
}

Command rotors(double front, double left, double back, double right) {
  return {0, 0, 0, 0, {front, left, back, right}};
}

RobotState in_the_air(const Vector3d& spin = Vector3d::Zero()) {
  RobotState s = at_rest(1, 2, 0.3);
  s.pose[2] = 100;
  s.twist = {1, -2, 3, spin.x(), spin.y(), spin.z()};
  return s;
}

Eigen::Quaterniond turn_of(const RobotState& s) { return {s.pose[3], s.pose[4], s.pose[5], s.pose[6]}; }
Vector3d place_of(const RobotState& s) { return {s.pose[0], s.pose[1], s.pose[2]}; }
Vector3d spin_of(const RobotState& s) { return {s.twist[3], s.twist[4], s.twist[5]}; }

TEST(Flight, AccelerationIsSimbodys) {
  const description::Robot robot = uneven(1e-4);
  const RobotModel model(robot);
  System system;
  const RobotBodies bodies = system.add(model);
  SimTK::Force::DiscreteForces given(system.forces, system.matter);
  system.finish();
  const Flight flight(whole_mass(robot), *robot.quadrotor);
  const Vector3d centre = whole_mass(robot).centre;
  std::mt19937 random(7);
  const auto draw = [&] { return static_cast<double>(random()) / 2147483648.0 - 1; };
  for (int trial = 0; trial < 20; ++trial) {
    SimTK::State state = system.state;
    Eigen::Quaterniond q(draw(), draw(), draw(), draw());
    q.normalize();
    const double place[] = {q.w(), q.x(), q.y(), q.z(), draw(), draw(), draw()};
    for (int k = 0; k < 7; ++k) state.updQ()[k] = place[k];
    for (int k = 0; k < 6; ++k) state.updU()[k] = 5 * draw();
    const Matrix3d r = q.toRotationMatrix();
    const Vector3d w(state.getU()[0], state.getU()[1], state.getU()[2]);
    const Vector3d v(state.getU()[3], state.getU()[4], state.getU()[5]);
    const description::RotorRates rates = {500 + 300 * draw(), 500 + 300 * draw(), 500 + 300 * draw(), 500};
    const auto wrench = robot.quadrotor->wrench(rates, r.transpose() * v, r.transpose() * w);
    const Vector3d force = r * wrench.force, torque = r * wrench.torque;
    given.setOneBodyForce(state, bodies.body,
                          {SimTK::Vec3(torque[0], torque[1], torque[2]), SimTK::Vec3(force[0], force[1], force[2])});
    system.system.realize(state, SimTK::Stage::Acceleration);
    const Vector3d turning(state.getUDot()[0], state.getUDot()[1], state.getUDot()[2]);
    const Vector3d origin(state.getUDot()[3], state.getUDot()[4], state.getUDot()[5]), arm = r * centre;
    const auto mine = flight.change(r, v + w.cross(arm), r.transpose() * w, Flight::spin(rates));
    EXPECT_LT((r * mine.w - turning).norm(), 1e-9 * (1 + turning.norm()));
    EXPECT_LT((mine.v - origin - turning.cross(arm) - w.cross(w.cross(arm))).norm(), 1e-9 * (1 + origin.norm()));
  }
}

// Without rotors and drag the centre of mass falls on a parabola, and the body conserves its angular momentum and
// energy. 10 s at 3.7 rad/s.
TEST(Flight, TumblingKeepsMomentumAndEnergy) {
  const description::Robot robot = uneven(0);
  const description::Mass whole = whole_mass(robot);
  const RobotState start = in_the_air({1, 2, 3});
  const auto centre = [&](const RobotState& s) { return Vector3d(place_of(s) + turn_of(s) * whole.centre); };
  const auto momentum = [&](const RobotState& s) {
    return Vector3d(turn_of(s) * (whole.inertia * (turn_of(s).conjugate() * spin_of(s))));
  };
  Fleet run({start}, robot, Integrator::midpoint, 0.01);
  double most = 0;  // change of its spin, which is constant without tumbling
  for (int k = 0; k < 1000; ++k) {
    run.tick(0.01, {rotors(0, 0, 0, 0)});
    most = std::max(most, (spin_of(run.states[0]) - spin_of(start)).norm());
    if (k == 300) run.states[0].pose[2] += 900;  // it would reach the ground
  }
  const RobotState& end = run.states[0];
  const Vector3d v = Vector3d(1, -2, 3) + spin_of(start).cross(turn_of(start) * whole.centre);
  const Vector3d fallen = centre(start) + 10 * v + Vector3d(0, 0, 900 - 50 * gravity);
  EXPECT_LT((centre(end) - fallen).norm(), 1e-9);
  EXPECT_LT((momentum(end) - momentum(start)).norm(), 1e-7 * momentum(start).norm());
  EXPECT_NEAR(momentum(end).dot(spin_of(end)), momentum(start).dot(spin_of(start)),
              1e-7 * momentum(start).dot(spin_of(start)));
  EXPECT_GT(most, 1);
}

// Commands that change each 0.2 s, at unequal rotors, with drag.
RobotState after_course(double h) {
  const description::Robot robot = uneven(8e-5);
  Fleet run({in_the_air({0.5, 0.2, -1})}, robot, Integrator::midpoint, h);
  run.states[0].rotors = {450, 450, 450, 450};
  for (int k = 0; k < 10; ++k) {
    const double t = 0.2 * k;
    run.tick(0.2, {rotors(460 + 5 * std::sin(3 * t), 455 - 5 * std::sin(2 * t), 450 + 5 * std::cos(t), 460)});
  }
  return run.states[0];
}

TEST(Flight, IsOfFourthOrder) {
  const RobotState limit = after_course(0.2 / 512);
  std::vector<double> errors;
  for (const int parts : {16, 32, 64}) {
    errors.push_back((place_of(after_course(0.2 / parts)) - place_of(limit)).norm());
  }
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 4, 0.3) << errors[0] << " " << errors[1];
  EXPECT_NEAR(std::log2(errors[1] / errors[2]), 4, 0.3) << errors[1] << " " << errors[2];
}

// Four rotors that speed up from rest: thrust by the square of their lag, so that the climb is a sum of exponentials.
// Steps of eight lags lose nothing of it.
TEST(Flight, ClimbsAsItsRotorsSpeedUpWhateverTheStep) {
  const description::Robot& robot = hummingbird();
  const auto& drive = *robot.quadrotor;
  const double rate = 500, t = 0.5, lag = drive.lag_up, mass = whole_mass(robot).mass;
  // Twice the integral of (1 - exp(-t / lag))^2.
  const double rise = t * t / 2 - 2 * lag * (t - lag * (1 - std::exp(-t / lag))) +
                      lag / 2 * (t - lag / 2 * (1 - std::exp(-2 * t / lag)));
  for (const double step : {0.1, 0.01, 0.001}) {
    RobotState start = at_rest(0, 0, 0);
    start.pose[2] = 10;
    Fleet run({start}, robot, Integrator::midpoint, step);
    for (int k = 0; k < 5; ++k) run.tick(0.1, {rotors(rate, rate, rate, rate)});
    EXPECT_NEAR(run.states[0].pose[2], 10 + 4 * drive.thrust_factor * rate * rate / mass * rise - gravity * t * t / 2,
                1e-7)
        << step;
    EXPECT_NEAR(run.states[0].rotors[2], rate * (1 - std::exp(-t / lag)), 1e-9) << step;
  }
}

// It leaves the ground when its thrust exceeds its weight; from then on its velocity is the integral of their
// difference, with either method.
TEST(Flight, TakesOffWhenThrustPassesWeight) {
  const auto& drive = *hummingbird().quadrotor;
  const double mass = whole_mass(hummingbird()).mass, rate = 480;
  const auto excess = [&](double t) {
    const double now = rate * (1 - std::exp(-t / drive.lag_up));
    return std::max(0.0, 4 * drive.thrust_factor * now * now / mass - gravity);
  };
  double velocity = 0;
  for (int k = 0; k < 100000; ++k) velocity += 5e-6 * excess((k + 0.5) * 5e-6);
  RobotState standing = at_rest(0, 0, 0);
  standing.pose[2] = 0.06;
  Fleet run({standing}, hummingbird());
  for (int k = 0; k < 100; ++k) run.tick(0.01, {rotors(0, 0, 0, 0)});
  for (int k = 0; k < 50; ++k) run.tick(0.01, {rotors(rate, rate, rate, rate)});
  EXPECT_NEAR(run.states[0].twist[2], velocity, 1e-3 * velocity);
}

// After a contact velocities are those half a step before: the same result as for those of the instant.
TEST(Flight, TakesUpVelocitiesOfHalfAStepBefore) {
  const description::Robot robot = uneven(0);
  Flight flight(whole_mass(robot), *robot.quadrotor);
  RobotState now = in_the_air();
  now.rotors = {450, 460, 470, 455};
  const double h = 0.01;
  const auto change = flight.change(turn_of(now).toRotationMatrix(), {1, -2, 3}, {0, 0, 0}, Flight::spin(now.rotors));
  RobotState before = now;
  before.memory.previous_step = h;
  const Vector3d turning = turn_of(now) * change.w,
                 v = change.v - turning.cross(turn_of(now) * whole_mass(robot).centre);
  for (int k = 0; k < 3; ++k) before.twist[k] -= h / 2 * v[k], before.twist[3 + k] -= h / 2 * turning[k];
  flight.step(h, now.rotors, now);
  flight.step(h, before.rotors, before);
  EXPECT_LT((place_of(before) - place_of(now)).norm(), 1e-6);
  EXPECT_LT((spin_of(before) - spin_of(now)).norm(), 1e-3);
  EXPECT_GT(turning.norm() * h / 2, 5e-3);
  EXPECT_EQ(before.memory.previous_step, 0);
}

TEST(Flight, DroppedItStandsOnTheGroundAndTakesOffAgain) {
  RobotState high = at_rest(0, 0, 0);
  high.pose[2] = 0.2;
  Fleet run({high}, hummingbird());
  for (int k = 0; k < 200; ++k) run.tick(0.01, {rotors(0, 0, 0, 0)});
  EXPECT_NEAR(run.states[0].pose[2], 0.06, 1e-4);
  EXPECT_LT(spin_of(run.states[0]).norm(), 1e-6);
  const double lift = 4 * hummingbird().quadrotor->thrust_factor * 500 * 500 / whole_mass(hummingbird()).mass - gravity;
  for (int k = 0; k < 100; ++k) run.tick(0.01, {rotors(500, 500, 500, 500)});
  EXPECT_NEAR(run.states[0].twist[2], lift * 1, 0.05 * lift);
  EXPECT_GT(lift, 1);
}

// A wall ahead stops it; near it, the stepper for contacts takes over and hands back.
TEST(Flight, AWallStopsIt) {
  RobotState s = at_rest(0, 0, 0);
  s.pose[2] = 1.5;
  s.twist = {2, 0, 0, 0, 0, 0};
  s.rotors = {453, 453, 453, 453};
  Fleet run({s}, hummingbird());
  run.among({{1, -2, 1, 2, 0, 3, 0.1, 0}}, 0.3);
  double farthest = 0;
  for (int k = 0; k < 60; ++k) {
    run.tick(0.01, {rotors(453, 453, 453, 453)});
    farthest = std::max(farthest, run.states[0].pose[0]);
  }
  EXPECT_LT(farthest, 0.95 - 0.25);
  EXPECT_GT(farthest, 0.95 - 0.30);
}

TEST(Flight, RemadeEngineAndNeighboursChangeNoBit) {
  const Command wild = rotors(500, 420, 480, 470);
  RobotState low = at_rest(0, 0, 0);
  low.pose[2] = 0.1;
  Fleet straight({low, in_the_air()}, hummingbird()), remade({low, in_the_air()}, hummingbird());
  Fleet alone({in_the_air()}, hummingbird());
  for (int k = 0; k < 60; ++k) {
    straight.tick(0.01, {rotors(300, 300, 310, 300), wild});
    if (k % 7 == 3) remade.remake();
    remade.tick(0.01, {rotors(300, 300, 310, 300), wild});
    alone.tick(0.01, {wild});
  }
  for (std::size_t i = 0; i < 2; ++i) expect_same_bits(straight.states[i], remade.states[i]);
  expect_same_bits(straight.states[1], alone.states[0]);
}

TEST(Flight, ScarabsBesideItDriveAsEver) {
  std::vector<NamedRobot> mixed = {{"bird", &hummingbird()}, {"r0", &scarab()}};
  const auto engine = make_engine(mixed, Integrator::midpoint, 1e-3);
  std::vector<RobotState> states = {in_the_air(), rolling(5, 1, 2, 0.4, 0)};
  Fleet alone({rolling(5, 1, 2, 0.4, 0)});
  for (int k = 0; k < 50; ++k) {
    engine->step(0.01, {rotors(450, 450, 450, 450), command(0.4, 0.5)}, states);
    alone.tick(0.01, {command(0.4, 0.5)});
  }
  expect_same_bits(states[1], alone.states[0]);
}

TEST(Flight, SimbodysOwnIntegratorsRefuseIt) {
  try {
    Fleet run({in_the_air()}, hummingbird(), Integrator::rk3);
    FAIL() << "nothing was thrown";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "robot 'r0' has no wheels: integrator=\"midpoint\" moves it");
  }
}

}  // namespace
}  // namespace muster::simbody
