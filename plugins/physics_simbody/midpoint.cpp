#include "midpoint.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "connected.hpp"

namespace muster::simbody {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

constexpr double fastest = 1e3;        // [m/s], [rad/s]: beyond, the motion has blown up
constexpr double longest_way = 0.005;  // [m] that a robot near others may go in one step: two make 1 cm
constexpr int most_parts = 100;
constexpr double nearby = 0.003;  // [m]

// A robot on a clear floor, and robots that touch walls or each other: many contacts agree on less, at a fraction of
// the cost, and their errors stay below a micrometre a step.
constexpr Search alone{1e-7, 1e-3, 12, true, false}, together{1e-5, 1e-2, 5, true, true};

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
Matrix3d matrix_of(const RobotState& s) {
  return Eigen::Quaterniond(s.pose[3], s.pose[4], s.pose[5], s.pose[6]).toRotationMatrix();
}
Vector3d velocity_of(const RobotState& s) { return {s.twist[0], s.twist[1], s.twist[2]}; }
Vector3d rates_of(const RobotState& s) { return {s.twist[3], s.twist[4], s.twist[5]}; }

Matrix3d cross_matrix(const Vector3d& v) {
  Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

// No part of the robot is faster.
double speed_of(const RobotModel& model, const RobotState& state) {
  double legs = 0;
  for (const double rate : state.leg_rate) legs = std::max(legs, 2 * model.leg_drive.radius * std::abs(rate));
  const Quaternion q = quaternion_of(state);
  const Vector3d rates = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).conjugate() * rates_of(state);
  return velocity_of(state).norm() + rates.cwiseAbs().dot(model.arm) + legs;
}

// What is further away is not met in a step: twice the way, since a contact may make a robot faster, and the fall.
double way_of(const RobotModel& model, const RobotState& state, double h) {
  return nearby + 2 * h * speed_of(model, state) + gravity * h * h;
}

void check_speed(const std::string& name, const RobotState& state) {
  for (const double speed : state.twist) {
    if (!(std::abs(speed) < fastest)) throw std::runtime_error("robot '" + name + "': its motion blew up");
  }
}

Extent extent_of(const RobotModel& model, const RobotState& state, double more) {
  const Eigen::Quaterniond turned_by(state.pose[3], state.pose[4], state.pose[5], state.pose[6]);
  const Vector3d middle = Vector3d(state.pose[0], state.pose[1], state.pose[2]) + turned_by * model.middle;
  const Vector3d reach = Vector3d::Constant(model.reach + more);
  return {middle - reach, middle + reach};
}

// What its rotors do to a robot, as a force for its velocities.
template <int N>
VelocityOf<N> rotor_force(const description::Quadrotor& rotors, const RobotState& state, const VelocityOf<N>& u) {
  const description::Wrench wrench = rotors.wrench(state.rotors, u.template segment<3>(3), u.template head<3>());
  VelocityOf<N> force = VelocityOf<N>::Zero();
  force.template head<3>() = wrench.torque;
  force.template segment<3>(3) = wrench.force;
  return force;
}

}  // namespace

// What the origin is faster by half a step ahead or behind than at the state's attitude, the mass centre being as fast.
// Robots that meet in the air carry the velocity of their mass centres from step to step, so that what two give each
// other is kept to the last digits.
template <int N>
Vector3d MidpointOf<N>::origin_lead(const Robot& robot, const RobotState& state) {
  return rates_of(state).cross((matrix_of(state) - robot.now.to_world) * robot.whole.centre);
}

template <int N>
MidpointOf<N>::MidpointOf(const std::vector<NamedRobot>& robots, double step, LegModel legs) : longest_step_(step) {
  for (const NamedRobot& named : robots) {
    Robot robot{named.name, RobotModel(*named.description), {}, {}, {}, {}, {}, {}};
    if (legs == LegModel::rigid) robot.model.leg_drive.stiffness = std::numeric_limits<double>::infinity();
    robot.bodies = system_.add(robot.model);
    robot.whole = whole_mass(*named.description);
    const Matrix3d c = cross_matrix(robot.whole.centre);
    robot.inertia_at_origin = robot.whole.inertia - robot.whole.mass * c * c;
    for (std::size_t w = 0; w < 2; ++w) robot.wheel_inertia[w] = robot.model.wheel[w].inertia(2, 2);
    if (robot.model.rotors) robot.flight.emplace(robot.whole, *robot.model.rotors);
    robots_.push_back(std::move(robot));
  }
  system_.finish();
  system_.system.realize(system_.state, SimTK::Stage::Position);
  read_masses();
  for (Robot& robot : robots_) {
    robot.now.model = &robot.model;
    robot.now.mass = robot.whole.mass;
    for (int k = 6; k < N; ++k) robot.now.body.previous[k] = 0;
  }
  groups_.resize(robots_.size());
}

template <int N>
void MidpointOf<N>::set_surroundings(const std::vector<scene::Slab>& walls, double friction) {
  friction_ = friction;
  walls_.clear();
  std::vector<Extent> extents;
  for (const scene::Slab& slab : walls) {
    const Solid wall = solid_of(slab);
    const Vector3d half = wall.axes.cwiseAbs() * wall.half;
    extents.push_back({wall.centre - half, wall.centre + half});
    walls_.push_back(wall);
  }
  broad_phase_.set_standing(std::move(extents));
}

// Simbody's own mass matrix at the reference pose; in the body's frame it is the same in every other, as wheels are
// balanced. Robots are not joined, so that one product has a column of each. Joints that are not there have an inertia
// of one, which nothing turns; legs are weighed anew in each step.
template <int N>
void MidpointOf<N>::read_masses() {
  const SimTK::State& state = system_.state;
  SimTK::Vector columns;
  for (Robot& robot : robots_) robot.now.body.mass.setIdentity();
  for (int c = 0; c < unknowns; ++c) {
    SimTK::Vector units(state.getNU(), 0.0);
    const auto has = [c](const Robot& robot) { return c < 6 || robot.model.has_wheels; };
    for (const Robot& robot : robots_) {
      if (has(robot)) units[robot.bodies.body.getFirstUIndex(state) + c] = 1;
    }
    system_.matter.multiplyByM(state, units, columns);
    for (Robot& robot : robots_) {
      const int first = robot.bodies.body.getFirstUIndex(state), own = robot.model.has_wheels ? unknowns : 6;
      robot.now.body.mass.col(c).setZero();
      robot.now.body.mass(c, c) = 1;
      for (int r = 0; has(robot) && r < own; ++r) robot.now.body.mass(r, c) = columns[first + r];
    }
  }
  for (Robot& robot : robots_) robot.now.body.inverse_mass = robot.now.body.mass.inverse();
}

template <int N>
void MidpointOf<N>::step(double dt, const std::vector<Command>& commands, std::vector<RobotState>& states) {
  const int count = std::max(1, static_cast<int>(std::ceil(dt / longest_step_ - 1e-9)));
  const double h = dt / count;
  for (int k = 0; k < count; ++k) {
    find_groups(h, states);
    int most = 1;
    for (const Group& group : groups_) most = std::max(most, group.parts);
    for (int part = 0; part < most; ++part) {
      const auto has_part = [&](const Group& group) { return !group.robots.empty() && part < group.parts; };
      for (const Group& group : groups_) {
        if (has_part(group)) advance(group, h / group.parts, (k + (part + 0.5) / group.parts) * h, commands, states);
      }
    }
  }
}

// Robots whose ways in this step may cross are of one group; it stands where its first robot does.
template <int N>
void MidpointOf<N>::find_groups(double h, const std::vector<RobotState>& states) {
  const int count = static_cast<int>(robots_.size());
  extents_.clear();
  for (int i = 0; i < count; ++i) {
    extents_.push_back(extent_of(robots_[i].model, states[i], way_of(robots_[i].model, states[i], h)));
  }
  broad_phase_.find(extents_);
  Connected connected(count);
  for (const auto& [i, j] : broad_phase_.among()) connected.join(i, j);
  for (Group& group : groups_) group.robots.clear(), group.pairs.clear(), group.walls.clear();
  for (int i = 0; i < count; ++i) groups_[connected.root(i)].robots.push_back(i);
  for (const auto& pair : broad_phase_.among()) groups_[connected.root(pair.first)].pairs.push_back(pair);
  for (const auto& pair : broad_phase_.with_standing()) groups_[connected.root(pair.first)].walls.push_back(pair);
  for (Group& group : groups_) group.parts = parts_of(group, h, states);
}

template <int N>
int MidpointOf<N>::parts_of(const Group& group, double h, const std::vector<RobotState>& states) const {
  if (group.pairs.empty() && group.walls.empty()) return 1;
  double fast = 0;
  for (const int i : group.robots) fast = std::max(fast, speed_of(robots_[i].model, states[i]));
  return static_cast<int>(std::clamp(std::ceil(fast * h / longest_way - 1e-9), 1.0, static_cast<double>(most_parts)));
}

template <int N>
VelocityOf<N> MidpointOf<N>::free_acceleration(std::size_t index, const Matrix3d& to_world, const Velocity& u) const {
  const Robot& robot = robots_[index];
  const Vector3d w = u.template head<3>(), centre = robot.whole.centre;
  const Vector3d axle = Vector3d::UnitY();
  const Vector3d weight = to_world.transpose() * Vector3d(0, 0, -gravity * robot.whole.mass);
  const Vector3d spin = (robot.wheel_inertia[0] * u[6] + robot.wheel_inertia[1] * u[7]) * axle;
  Velocity force = Velocity::Zero();
  force.template head<3>() = centre.cross(weight) - w.cross(robot.inertia_at_origin * w + spin);
  force.template segment<3>(3) = weight - robot.whole.mass * w.cross(w.cross(centre));
  return robot.now.body.inverse_mass.lazyProduct(force);
}

template <int N>
void MidpointOf<N>::advance(const Group& group, double h, double at, const std::vector<Command>& commands,
                            std::vector<RobotState>& states) {
  if (is_in_the_air(group, h, states)) {
    const int i = group.robots.front();
    return fly(i, h, commands[i], states[i]);
  }
  for (const int i : group.robots) place(i, h, at, commands[i], states[i]);
  meet(group, h, states);
  solve_islands(group, states);
  for (const int i : group.robots) finish(robots_[i], h, commands[i], states[i]);
}

template <int N>
bool MidpointOf<N>::is_in_the_air(const Group& group, double h, const std::vector<RobotState>& states) const {
  const int i = group.robots.front();
  const RobotModel& model = robots_[i].model;
  if (!robots_[i].flight || !group.pairs.empty() || !group.walls.empty()) return false;
  const Quaternion q = quaternion_of(states[i]);
  const Vector3d up = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix().row(2);
  return states[i].pose[2] + model.lowest_point(up) > way_of(model, states[i], h);
}

template <int N>
void MidpointOf<N>::fly(int index, double h, const Command& command, RobotState& state) {
  robots_[index].flight->step(h, command.rotors, state);
  check_speed(robots_[index].name, state);
}

// Half a step ahead along the velocities that stand. The one rotation that is needed follows from its quaternion: to
// have Simbody work out the places of all bodies takes twice as long as all the rest of a step.
template <int N>
void MidpointOf<N>::place(int index, double h, double at, const Command& command, const RobotState& state) {
  Robot& robot = robots_[index];
  auto& now = robot.now;
  now.turned = turned(quaternion_of(state), quaternion_of(state), rates_of(state), 0.5 * h);
  now.to_world =
      Eigen::Quaterniond(now.turned[0], now.turned[1], now.turned[2], now.turned[3]).normalized().toRotationMatrix();
  for (int k = 0; k < 3; ++k) now.position[k] = state.pose[k] + 0.5 * h * state.twist[k];
  now.speed = speed_of(robot.model, state);
  now.body.previous.template head<3>() = now.to_world.transpose() * rates_of(state);
  Vector3d v = velocity_of(state);
  if (robot.flight) v += origin_lead(robot, state);
  now.body.previous.template segment<3>(3) = now.to_world.transpose() * v;
  if (robot.model.legs.empty()) {
    place_wheels(robot, index, h, at, command, state);
  } else {
    place_legs(robot, h, at, command, state);
  }
}

template <int N>
void MidpointOf<N>::place_wheels(Robot& robot, int index, double h, double at, const Command& command,
                                 const RobotState& state) {
  const auto& drive = robot.model.drive;
  auto& body = robot.now.body;
  for (int w = 0; w < 2; ++w) body.previous[6 + w] = state.rate[w];
  const double kick = 0.5 * (state.memory.previous_step + h);
  body.free = body.previous + kick * free_acceleration(index, robot.now.to_world, body.previous);
  if (robot.model.rotors) {
    body.free += kick * (body.inverse_mass * rotor_force<N>(*robot.model.rotors, state, body.previous));
    const Vector3d w = body.previous.template head<3>();  // in origin_lead() already
    body.free.template segment<3>(3) += kick * w.cross(w.cross(robot.whole.centre));
  }
  const double asked[] = {command.left + at * command.left_rate, command.right + at * command.right_rate};
  for (int w = 0; w < 2; ++w) body.motors[w] = {drive.limited_rate(asked[w]), drive.max_torque * h};
}

template <int N>
void MidpointOf<N>::place_legs(Robot& robot, double h, double at, const Command& command, const RobotState& state) {
  if constexpr (N == unknowns_with_legs) {
    auto& body = robot.now.body;
    for (int i = 0; i < 6; ++i) {
      robot.now.leg_angle[i] = state.leg_angle[i] + 0.5 * h * state.leg_rate[i];
      body.previous[6 + i] = state.leg_rate[i];
      body.motors[i] = leg_motor(robot.model.leg_drive, command.leg_angle[i] + at * command.leg_rate[i],
                                 command.leg_rate[i], state.leg_angle[i], h);
    }
    const Vector3d fall = robot.now.to_world.transpose() * Vector3d(0, 0, -gravity);
    // Weighed as they stand at the step's start, between the two velocities: half a step later, legs would be damped.
    const LeggedMass legged = weigh(robot.model, state.leg_angle, body.previous, fall);
    body.mass = legged.mass;
    body.inverse_mass = inverse(legged.mass);
    const double kick = 0.5 * (state.memory.previous_step + h);
    body.free = body.previous + kick * (body.inverse_mass * legged.force);
  }
}

template <int N>
void MidpointOf<N>::meet(const Group& group, double h, const std::vector<RobotState>& states) {
  encounters_.begin(h, friction_);
  for (const int i : group.robots) encounters_.with_ground(i, robots_[i].now, states[i].memory);
  if (group.pairs.empty() && group.walls.empty()) return;
  for (const int i : group.robots) place_parts(robots_[i].now);
  for (const auto& [i, wall] : group.walls)
    encounters_.with_wall(i, robots_[i].now, states[i].memory, wall, walls_[wall]);
  for (const auto& [i, j] : group.pairs) encounters_.between(i, robots_[i].now, states[i].memory, j, robots_[j].now);
}

// Robots that touch are solved for together, the others apart: the same, but faster.
template <int N>
void MidpointOf<N>::solve_islands(const Group& group, std::vector<RobotState>& states) {
  Connected connected(static_cast<int>(group.robots.size()));
  const auto member = [&](int robot) {
    return static_cast<int>(std::lower_bound(group.robots.begin(), group.robots.end(), robot) - group.robots.begin());
  };
  for (const auto& c : encounters_.contacts) {
    if (c.other >= 0) connected.join(member(c.body), member(c.other));
  }
  if (islands_.size() < group.robots.size()) islands_.resize(group.robots.size());
  for (std::size_t i = 0; i < group.robots.size(); ++i) islands_[i].robots.clear(), islands_[i].contacts.clear();
  for (const int i : group.robots) islands_[connected.root(member(i))].robots.push_back(i);
  for (std::size_t k = 0; k < encounters_.contacts.size(); ++k)
    islands_[connected.root(member(encounters_.contacts[k].body))].contacts.push_back(static_cast<int>(k));
  for (std::size_t i = 0; i < group.robots.size(); ++i) {
    if (!islands_[i].robots.empty()) solve(islands_[i], states);
  }
}

template <int N>
void MidpointOf<N>::solve(const Island& island, std::vector<RobotState>& states) {
  const auto member = [&](int robot) {
    return static_cast<int>(std::lower_bound(island.robots.begin(), island.robots.end(), robot) -
                            island.robots.begin());
  };
  const auto on_clear_floor = [&](int k) { return encounters_.traces[k].id == 0; };
  const auto slipped = [&](int k) {
    const auto& c = encounters_.contacts[k];
    return c.friction > 0 && c.grip.norm() > 0.99 * c.friction * c.push && c.push > 0;
  };
  problem_.search = std::all_of(island.contacts.begin(), island.contacts.end(), on_clear_floor) ? alone : together;
  // Feet that slipped, as those of a tripod do that sways, will again.
  if (N > unknowns && std::any_of(island.contacts.begin(), island.contacts.end(), slipped)) {
    problem_.search.guess = false;
  }
  problem_.bodies.resize(island.robots.size());
  problem_.contacts.clear();
  for (std::size_t i = 0; i < island.robots.size(); ++i) problem_.bodies[i] = robots_[island.robots[i]].now.body;
  for (const int k : island.contacts) {
    ContactOf<N> contact = encounters_.contacts[k];
    contact.body = member(contact.body);
    if (contact.other >= 0) contact.other = member(contact.other);
    problem_.contacts.push_back(contact);
  }
  const Outcome outcome = solver_.solve(problem_);
  ++count_.solved;
  count_.unsettled += !outcome.converged;
  count_.failed += !outcome.minimised;
  for (std::size_t i = 0; i < island.robots.size(); ++i) {
    robots_[island.robots[i]].now.body.velocity = problem_.bodies[i].velocity;
    states[island.robots[i]].memory = Memory();
  }
  for (std::size_t k = 0; k < island.contacts.size(); ++k) {
    const Trace& trace = encounters_.traces[island.contacts[k]];
    keep(problem_.contacts[k], trace, states[trace.robot].memory);
  }
}

template <int N>
void MidpointOf<N>::finish(Robot& robot, double h, const Command& command, RobotState& state) const {
  const Velocity& u = robot.now.body.velocity;
  if (!(u.cwiseAbs().maxCoeff() < fastest)) throw std::runtime_error("robot '" + robot.name + "': its motion blew up");

  const Vector3d w = robot.now.to_world * u.template head<3>(), v = robot.now.to_world * u.template segment<3>(3);
  const Quaternion q = turned(quaternion_of(state), robot.now.turned, w, h);
  const double size = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  for (int k = 0; k < 4; ++k) state.pose[3 + k] = q[k] / size;
  for (int k = 0; k < 3; ++k) {
    state.pose[k] += h * v[k];
    state.twist[k] = v[k];
    state.twist[3 + k] = w[k];
  }
  if (robot.flight) {
    const Vector3d lead = origin_lead(robot, state);
    for (int k = 0; k < 3; ++k) state.twist[k] -= lead[k];
  }
  for (int k = 0; k < 2 && robot.model.legs.empty(); ++k) {
    state.angle[k] += h * u[6 + k];
    state.rate[k] = u[6 + k];
  }
  for (std::size_t k = 0; k < robot.model.legs.size(); ++k) {
    const double rate = u[6 + static_cast<int>(k)];
    state.leg_angle[k] += h * rate;
    state.leg_rate[k] = rate;
    state.leg_torque[k] = robot.now.body.motors[k].impulse(rate) / h;
  }
  if (const auto& rotors = robot.model.rotors)
    state.rotors = rotors->later(state.rotors, command.rotors, rotors->decay(h));
  state.memory.previous_step = h;
}

template class MidpointOf<unknowns>;
template class MidpointOf<unknowns_with_legs>;

}  // namespace muster::simbody
