#include "midpoint.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace muster::simbody {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

// Stiffness and damping of a normal contact, by the robot's weight: a Scarab of 8 kg sinks by 0.03 mm in all.
constexpr double stiffness_per_mass = 125000;  // [1/s2]
constexpr double damping_per_mass = 2500;      // [1/s]
constexpr double push_out = 0.2;               // fastest way out of the ground [m/s]
constexpr double fastest = 1e3;                // [m/s], [rad/s]: beyond, the motion has blown up

// Quaternions as pose columns: w x y z from index 3.
using Quaternion = std::array<double, 4>;

// q + s/2 (0, w) q_at, w in the world's frame: a step along the sphere's tangent, not of unit length.
Quaternion turned(const Quaternion& q, const Quaternion& at, const Vector3d& w, double s) {
  const double a = 0.5 * s;
  return {
      q[0] + a * (-at[1] * w[0] - at[2] * w[1] - at[3] * w[2]), q[1] + a * (at[0] * w[0] + w[1] * at[3] - w[2] * at[2]),
      q[2] + a * (at[0] * w[1] + w[2] * at[1] - w[0] * at[3]), q[3] + a * (at[0] * w[2] + w[0] * at[2] - w[1] * at[1])};
}

Quaternion quaternion_of(const RobotState& s) { return {s.pose[3], s.pose[4], s.pose[5], s.pose[6]}; }
Vector3d velocity_of(const RobotState& s) { return {s.twist[0], s.twist[1], s.twist[2]}; }
Vector3d rates_of(const RobotState& s) { return {s.twist[3], s.twist[4], s.twist[5]}; }

Matrix3d eigen(const SimTK::Rotation& r) {
  Matrix3d m;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) m(i, j) = r[i][j];
  }
  return m;
}

Matrix3d cross_matrix(const Vector3d& v) {
  Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

// The row that gives the speed along `direction` of the body's point `arm`, all in the body's frame.
Velocity point_row(const Vector3d& arm, const Vector3d& direction) {
  Velocity row;
  row << arm.cross(direction), direction, 0, 0;
  return row;
}

}  // namespace

Midpoint::Midpoint(const std::vector<NamedRobot>& robots, double step) : longest_step_(step) {
  for (const NamedRobot& named : robots) {
    Robot robot{named.name, RobotModel(*named.description), {}, 0, 0, {}, {}, {}, {}, {}, {}, {}};
    robot.bodies = system_.add(robot.model);
    robot.whole = whole_mass(*named.description);
    const Matrix3d c = cross_matrix(robot.whole.centre);
    robot.inertia_at_origin = robot.whole.inertia - robot.whole.mass * c * c;
    for (std::size_t w = 0; w < 2; ++w) {
      robot.wheel_centre[w] = robot.model.wheel_frame[w].translation();
      robot.wheel_inertia[w] = robot.model.wheel[w].inertia(2, 2);
    }
    robots_.push_back(std::move(robot));
  }
  system_.finish();
  system_.system.realize(system_.state, SimTK::Stage::Position);
  for (Robot& robot : robots_) read_mass(robot);
}

// Simbody's own mass matrix at the reference pose; in the body's frame it is the same in every other, as wheels are
// balanced.
void Midpoint::read_mass(Robot& robot) {
  const SimTK::State& state = system_.state;
  robot.first_q = robot.bodies.body.getFirstQIndex(state);
  robot.first_u = robot.bodies.body.getFirstUIndex(state);
  SimTK::Vector unit(state.getNU(), 0.0), column;
  for (int c = 0; c < unknowns; ++c) {
    unit[robot.first_u + c] = 1;
    system_.matter.multiplyByM(state, unit, column);
    unit[robot.first_u + c] = 0;
    for (int r = 0; r < unknowns; ++r) robot.mass(r, c) = column[robot.first_u + r];
  }
  robot.inverse_mass = robot.mass.inverse();
}

void Midpoint::step(double dt, const std::vector<Command>& commands, std::vector<RobotState>& states) {
  const int count = std::max(1, static_cast<int>(std::ceil(dt / longest_step_ - 1e-9)));
  const double h = dt / count;
  for (int k = 0; k < count; ++k) {
    move_to_middle(h, states);
    for (std::size_t i = 0; i < robots_.size(); ++i) advance(robots_[i], h, (k + 0.5) * h, commands[i], states[i]);
  }
}

// Puts Simbody's state half a step ahead along the velocities that stand.
void Midpoint::move_to_middle(double h, const std::vector<RobotState>& states) {
  SimTK::Vector& q = system_.state.updQ();
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    const RobotState& s = states[i];
    double* to = &q[robots_[i].first_q];
    const Quaternion middle = turned(quaternion_of(s), quaternion_of(s), rates_of(s), 0.5 * h);
    std::copy(middle.begin(), middle.end(), to);
    for (int k = 0; k < 3; ++k) to[4 + k] = s.pose[k] + 0.5 * h * s.twist[k];
    for (int w = 0; w < 2; ++w) to[7 + w] = s.angle[w] + 0.5 * h * s.rate[w];
  }
  system_.system.realize(system_.state, SimTK::Stage::Position);
}

Velocity Midpoint::free_acceleration(std::size_t index, const Matrix3d& to_world, const Velocity& u) const {
  const Robot& robot = robots_[index];
  const Vector3d w = u.head<3>(), centre = robot.whole.centre;
  const Vector3d axle = Vector3d::UnitY();
  const Vector3d weight = to_world.transpose() * Vector3d(0, 0, -gravity * robot.whole.mass);
  const Vector3d spin = (robot.wheel_inertia[0] * u[6] + robot.wheel_inertia[1] * u[7]) * axle;
  Velocity force;
  force << centre.cross(weight) - w.cross(robot.inertia_at_origin * w + spin),
      weight - robot.whole.mass * w.cross(w.cross(centre)), 0, 0;
  return robot.inverse_mass * force;
}

void Midpoint::set_contacts(Robot& robot, double h, double height, const Matrix3d& to_world,
                            const RobotState& state) const {
  const double stiffness = stiffness_per_mass * robot.whole.mass, damping = damping_per_mass * robot.whole.mass;
  const double share = h * stiffness / (h * stiffness + damping);  // of a penetration that one step takes back
  const Matrix3d to_body = to_world.transpose();
  const Vector3d up = to_body.col(2);
  const auto contact = [&](const Vector3d& centre, double radius) {
    const Vector3d arm = centre - radius * up;
    Contact c;
    c.normal = point_row(arm, up);
    for (int k = 0; k < 2; ++k) c.tangent[k] = point_row(arm, to_body.col(k));
    c.softness = 1 / (h * (h * stiffness + damping));
    const double gap = height + up.dot(arm) - 0.5 * h * c.normal.dot(robot.problem.previous);  // at the step's start
    c.target = gap > 0 ? -gap / h : std::min(-share * gap / h, push_out);
    return c;
  };
  robot.problem.contacts.clear();
  for (std::size_t w = 0; w < 2; ++w) {
    const double radius = robot.model.drive.wheel_radius;
    Contact c = contact(robot.wheel_centre[w], radius);
    const Vector3d surface = Vector3d::UnitY().cross(-radius * up);  // of the tread, per rate
    for (int k = 0; k < 2; ++k) c.tangent[k][static_cast<int>(6 + w)] = surface.dot(to_body.col(k));
    c.friction = robot.model.drive.friction;
    const auto& impulse = state.memory.impulse[w];
    c.push = impulse[0];
    c.grip = {impulse[1], impulse[2]};
    robot.problem.contacts.push_back(c);
  }
  for (const Slider& slider : robot.model.sliders)
    robot.problem.contacts.push_back(contact(slider.centre, slider.radius));
}

void Midpoint::advance(Robot& robot, double h, double at, const Command& command, RobotState& state) {
  const auto& drive = robot.model.drive;
  const SimTK::Transform& pose = robot.bodies.body.getBodyTransform(system_.state);
  const Matrix3d to_world = eigen(pose.R());
  Problem& problem = robot.problem;
  problem.mass = robot.mass;
  problem.inverse_mass = robot.inverse_mass;
  problem.previous << to_world.transpose() * rates_of(state), to_world.transpose() * velocity_of(state), state.rate[0],
      state.rate[1];
  const double kick = 0.5 * (state.memory.previous_step + h);
  problem.free = problem.previous + kick * free_acceleration(&robot - robots_.data(), to_world, problem.previous);
  set_contacts(robot, h, pose.p()[2], to_world, state);
  const double asked[] = {command.left + at * command.left_rate, command.right + at * command.right_rate};
  for (int w = 0; w < 2; ++w) problem.motors[w] = {drive.limited_rate(asked[w]), drive.max_torque * h};

  const Velocity u = solve(problem).velocity;
  if (!(u.cwiseAbs().maxCoeff() < fastest)) throw std::runtime_error("robot '" + robot.name + "': its motion blew up");

  const Vector3d w = to_world * u.head<3>(), v = to_world * u.segment<3>(3);
  const double* middle = &system_.state.getQ()[robot.first_q];
  const Quaternion q = turned(quaternion_of(state), {middle[0], middle[1], middle[2], middle[3]}, w, h);
  const double size = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  for (int k = 0; k < 4; ++k) state.pose[3 + k] = q[k] / size;
  for (int k = 0; k < 3; ++k) {
    state.pose[k] += h * v[k];
    state.twist[k] = v[k];
    state.twist[3 + k] = w[k];
  }
  for (int k = 0; k < 2; ++k) {
    state.angle[k] += h * u[6 + k];
    state.rate[k] = u[6 + k];
    const Contact& c = problem.contacts[k];
    state.memory.impulse[k] = {c.push, c.grip[0], c.grip[1]};
  }
  state.memory.previous_step = h;
}

}  // namespace muster::simbody
