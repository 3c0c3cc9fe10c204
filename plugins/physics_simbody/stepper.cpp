#include "stepper.hpp"

#include <algorithm>
#include <cmath>

#include "motion.hpp"

namespace muster::simbody {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

// Tolerances for a robot on a clear floor, and for robots that touch walls or each other: with many contacts looser
// ones, at a fraction of the cost, with errors below a micrometre a step.
constexpr Search alone{1e-7, 1e-3, 12, Search::First::all_sticks, false},
    together{1e-5, 1e-2, 5, Search::First::as_before, true};

constexpr int most_halvings = 2;

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
// Force of the rotors on a robot's velocities.
Velocity rotor_force(const description::Quadrotor& rotors, const RobotState& state, const Velocity& u) {
  const description::Wrench wrench = rotors.wrench(state.rotors, u.segment<3>(3), u.head<3>());
  Velocity force = Velocity::Zero();
  force.head<3>() = wrench.torque;
  force.segment<3>(3) = wrench.force;
  return force;
}

// Difference of the origin's velocity between half a step ahead or behind and the state's attitude, at equal velocity
// of the mass centre. Robots without legs and limbs carry the velocity of their mass centres from step to step, so
// exchanged momentum is conserved to the last digits.
Vector3d origin_lead(const CrewMember& robot, const Matrix3d& to_world, const RobotState& state) {
  const Vector3d& centre = robot.whole.centre;
  return rates_of(state).cross(attitude_of(state) * centre - to_world * centre);
}

int place_in(const std::vector<int>& robots, int robot) {
  return static_cast<int>(std::lower_bound(robots.begin(), robots.end(), robot) - robots.begin());
}

}  // namespace

template <int N>
StepperOf<N>::StepperOf(Arena& arena) : arena_(arena), somebody_bounces_(arena.crew.any_bounces()) {}

template <int N>
std::vector<PlacedOf<N>>& StepperOf<N>::placed() const {
  if constexpr (N == unknowns) {
    return arena_.placed;
  } else {
    return arena_.placed_with_legs;
  }
}

template <int N>
void StepperOf<N>::advance(const Group& group, double h, double at, const std::vector<Command>& commands,
                           std::vector<RobotState>& states) {
  prepare(group, h, at, commands, states);
  if (somebody_bounces_ && bounces(group)) {
    go_by_impacts(group, h, at, commands, states);
  } else {
    complete(group, h, at, commands, states);
  }
}

// Computes robots half a step ahead, and their contacts there.
template <int N>
void StepperOf<N>::prepare(const Group& group, double h, double at, const std::vector<Command>& commands,
                           const std::vector<RobotState>& states) {
  for (const int i : group.robots) place(i, h, at, commands[i], states[i]);
  meet(group, h, states);
  find_islands(group);
}

// Completes the prepared step. Robots in contact for which it is too long take it in two halves, which may be divided
// again.
template <int N>
void StepperOf<N>::complete(const Group& group, double h, double at, const std::vector<Command>& commands,
                            std::vector<RobotState>& states, int halvings) {
  std::vector<Group> in_halves;
  for (std::size_t k = 0; k < group.robots.size(); ++k) {
    const Island& island = islands_[k];
    if (halvings < most_halvings && needs_halves(island)) {
      in_halves.push_back(part_of(group, island));
      continue;
    }
    if (!island.robots.empty()) solve(island, h, states);
    for (const int i : island.robots) finish(i, h, commands[i], states[i]);
  }
  for (const Group& part : in_halves) {
    for (const double half : {-0.25, 0.25}) {
      prepare(part, h / 2, at + half * h, commands, states);
      complete(part, h / 2, at + half * h, commands, states, halvings + 1);
    }
  }
}

template <int N>
bool StepperOf<N>::needs_halves(const Island& island) const {
  return std::any_of(island.contacts.begin(), island.contacts.end(),
                     [&](int k) { return encounters_.traces[k].step_is_too_long; });
}

template <int N>
Group StepperOf<N>::part_of(const Group& group, const Island& island) {
  Group part;
  part.robots = island.robots;
  const auto is_in = [&](int robot) { return std::binary_search(island.robots.begin(), island.robots.end(), robot); };
  for (const auto& pair : group.pairs) {
    if (is_in(pair.first) && is_in(pair.second)) part.pairs.push_back(pair);
  }
  for (const auto& pair : group.walls) {
    if (is_in(pair.first)) part.walls.push_back(pair);
  }
  return part;
}

// Half a step ahead along the present velocities. The one rotation needed follows from its quaternion: computing the
// positions of all bodies by Simbody costs twice as much as the rest of a step.
template <int N>
void StepperOf<N>::place(int index, double h, double at, const Command& command, const RobotState& state) {
  const CrewMember& robot = arena_.crew[index];
  auto& now = placed()[index];
  now.turned = turned(quaternion_of(state), quaternion_of(state), rates_of(state), 0.5 * h);
  now.to_world =
      Eigen::Quaterniond(now.turned[0], now.turned[1], now.turned[2], now.turned[3]).normalized().toRotationMatrix();
  for (int k = 0; k < 3; ++k) now.position[k] = state.pose[k] + 0.5 * h * state.twist[k];
  now.speed = speed_of(robot.model, state);
  now.body.previous.template head<3>() = now.to_world.transpose() * rates_of(state);
  Vector3d v = velocity_of(state);
  if (robot.is_rigid()) v += origin_lead(robot, now.to_world, state);
  now.body.previous.template segment<3>(3) = now.to_world.transpose() * v;
  if (robot.model.has_wheels && robot.model.drive.steering)
    now.steering = command.steering + at * command.steering_rate;
  if (robot.with_four_wheels) {
    place_mecanum(robot, h, at, command, state, now);
  } else if (!robot.model.legs.empty()) {
    place_legs(robot, h, at, command, state, now);
  } else if (!robot.model.limbs.empty()) {
    place_limbs(robot, h, at, command, state, now);
  } else {
    place_wheels(robot, h, at, command, state, now);
  }
}

template <int N>
void StepperOf<N>::place_wheels(const CrewMember& robot, double h, double at, const Command& command,
                                const RobotState& state, PlacedOf<N>& now) {
  const auto& drive = robot.model.drive;
  auto& body = now.body;
  for (int w = 0; w < 2; ++w) body.previous[6 + w] = state.rate[w];
  const Velocity previous = body.previous.template head<unknowns>();
  const double kick = 0.5 * (state.memory.previous_step + h);
  Velocity free = previous + kick * robot.free_acceleration(now.to_world, previous);
  if (robot.model.rotors) free += kick * (robot.inverse_mass * rotor_force(*robot.model.rotors, state, previous));
  body.free = body.previous;  // idle joints are at rest
  body.free.template head<unknowns>() = free;
  const double asked[] = {command.left + at * command.left_rate, command.right + at * command.right_rate};
  for (int w = 0; w < 2; ++w) body.motors[w] = {drive.limited_rate(asked[w]), drive.max_torque * h};
}

template <int N>
void StepperOf<N>::place_mecanum(const CrewMember& robot, double h, double at, const Command& command,
                                 const RobotState& state, PlacedOf<N>& now) {
  if constexpr (N == unknowns_with_legs) {
    const auto& drive = robot.model.drive;
    auto& body = now.body;
    const double rates[] = {state.rate[0], state.rate[1], state.rear_rate[0], state.rear_rate[1]};
    const double asked[] = {command.left + at * command.left_rate, command.right + at * command.right_rate,
                            command.rear[0] + at * command.rear_rate[0], command.rear[1] + at * command.rear_rate[1]};
    for (int w = 0; w < 4; ++w) {
      body.previous[6 + w] = rates[w];
      body.motors[w] = {drive.limited_rate(asked[w]), drive.max_torque * h};
    }
    const double kick = 0.5 * (state.memory.previous_step + h);
    body.free = body.previous + kick * robot.free_acceleration_with_four_wheels(now.to_world, body.previous);
  }
}

template <int N>
void StepperOf<N>::place_legs(const CrewMember& robot, double h, double at, const Command& command,
                              const RobotState& state, PlacedOf<N>& now) {
  if constexpr (N == unknowns_with_legs) {
    auto& body = now.body;
    for (int i = 0; i < 6; ++i) {
      now.leg_angle[i] = state.leg_angle[i] + 0.5 * h * state.leg_rate[i];
      body.previous[6 + i] = state.leg_rate[i];
      body.motors[i] = leg_motor(robot.model.leg_drive, command.leg_angle[i] + at * command.leg_rate[i],
                                 command.leg_rate[i], state.leg_angle[i], h);
    }
    const Vector3d fall = now.to_world.transpose() * Vector3d(0, 0, -gravity);
    // Mass matrix of the posture at the step's start, between the two velocities: that of half a step later would damp
    // legs.
    const LeggedMass legged = weigh(robot.model, state.leg_angle, body.previous, fall);
    now.inertia = {legged.mass, inverse(legged.mass)};
    const double kick = 0.5 * (state.memory.previous_step + h);
    body.free = body.previous + kick * (now.inertia.inverse * legged.force);
  }
}

// Contacts refer to robots by their place in the group.
template <int N>
void StepperOf<N>::meet(const Group& group, double h, const std::vector<RobotState>& states) {
  encounters_.begin(h, arena_.friction, somebody_bounces_);
  const auto slot = [&](int robot) { return place_in(group.robots, robot); };
  for (std::size_t k = 0; k < group.robots.size(); ++k) {
    const int i = group.robots[k];
    encounters_.with_ground(static_cast<int>(k), placed()[i], states[i].memory);
  }
  if (group.pairs.empty() && group.walls.empty()) return;
  for (const int i : group.robots) place_parts(placed()[i]);
  for (const auto& [i, wall] : group.walls)
    encounters_.with_wall(slot(i), placed()[i], states[i].memory, wall, arena_.walls[wall]);
  for (const auto& [i, j] : group.pairs)
    encounters_.between(slot(i), placed()[i], states[i].memory, slot(j), placed()[j]);
}

// Robots in contact are solved together, the others separately: the same, but faster. An island is stored at its first
// robot's place.
template <int N>
void StepperOf<N>::find_islands(const Group& group) {
  const std::size_t count = group.robots.size();
  connected_.begin(static_cast<int>(count));
  for (const auto& c : encounters_.contacts) {
    if (c.other >= 0) connected_.join(c.body, c.other);
  }
  if (islands_.size() < count) islands_.resize(count);
  for (std::size_t i = 0; i < count; ++i) islands_[i].robots.clear(), islands_[i].contacts.clear();
  place_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    std::vector<int>& robots = islands_[connected_.root(static_cast<int>(i))].robots;
    place_[i] = static_cast<int>(robots.size());
    robots.push_back(group.robots[i]);
  }
  for (std::size_t k = 0; k < encounters_.contacts.size(); ++k)
    islands_[connected_.root(encounters_.contacts[k].body)].contacts.push_back(static_cast<int>(k));
}

// Moves contacts into the problem, whose bodies are the island's. If that is the whole group, their numbers are the
// same.
template <int N>
void StepperOf<N>::take_contacts(const Island& island) {
  if (island.robots.size() == place_.size()) return std::swap(problem_.contacts, encounters_.contacts);
  problem_.contacts.clear();
  for (const int k : island.contacts) {
    problem_.contacts.push_back(encounters_.contacts[k]);
    auto& contact = problem_.contacts.back();
    contact.body = place_[contact.body];
    if (contact.other >= 0) contact.other = place_[contact.other];
  }
}

template <int N>
void StepperOf<N>::solve(const Island& island, double h, std::vector<RobotState>& states) {
  const auto on_clear_floor = [&](int k) { return encounters_.traces[k].id <= 0; };
  problem_.search = std::all_of(island.contacts.begin(), island.contacts.end(), on_clear_floor) ? alone : together;
  problem_.bodies.resize(island.robots.size());
  for (std::size_t i = 0; i < island.robots.size(); ++i) problem_.bodies[i] = placed()[island.robots[i]].body;
  take_contacts(island);
  solve_problem();
  if (push_again(island, h, states)) solve_problem();
  for (std::size_t i = 0; i < island.robots.size(); ++i) {
    placed()[island.robots[i]].body.velocity = problem_.bodies[i].velocity;
    states[island.robots[i]].memory = Memory();
  }
  for (std::size_t k = 0; k < island.contacts.size(); ++k) {
    const Trace& trace = encounters_.traces[island.contacts[k]];
    keep(problem_.contacts[k], trace, states[trace.robot].memory);
  }
}

template <int N>
void StepperOf<N>::solve_problem() {
  const Outcome outcome = solver_.solve(problem_);
  ++count_.solved;
  count_.unsettled += !outcome.converged;
  count_.failed += !outcome.minimised;
}

template <int N>
void StepperOf<N>::finish(int index, double h, const Command& command, RobotState& state) const {
  const CrewMember& robot = arena_.crew[index];
  const PlacedOf<N>& now = placed()[index];
  const VelocityOf<N>& u = now.body.velocity;
  check_speed(robot.name, u.cwiseAbs().maxCoeff());

  const Vector3d w = now.to_world * u.template head<3>(), v = now.to_world * u.template segment<3>(3);
  const Quaternion q = turned(quaternion_of(state), now.turned, w, h);
  const double size = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  for (int k = 0; k < 4; ++k) state.pose[3 + k] = q[k] / size;
  for (int k = 0; k < 3; ++k) {
    state.pose[k] += h * v[k];
    state.twist[k] = v[k];
    state.twist[3 + k] = w[k];
  }
  if (robot.is_rigid()) {
    const Vector3d lead = origin_lead(robot, now.to_world, state);
    for (int k = 0; k < 3; ++k) state.twist[k] -= lead[k];
  }
  for (int k = 0; k < 2 && robot.model.has_wheels; ++k) {
    state.angle[k] += h * u[6 + k];
    state.rate[k] = u[6 + k];
  }
  if constexpr (N == unknowns_with_legs) {
    for (int k = 0; k < 2 && robot.with_four_wheels; ++k) {
      state.rear_angle[k] += h * u[8 + k];
      state.rear_rate[k] = u[8 + k];
    }
  }
  finish_limbs(robot, h, now, state);
  for (std::size_t k = 0; k < robot.model.legs.size(); ++k) {
    const double rate = u[6 + static_cast<int>(k)];
    state.leg_angle[k] += h * rate;
    state.leg_rate[k] = rate;
    if (h > 0) state.leg_torque[k] = now.body.motors[k].impulse(rate) / h;
  }
  if (const auto& rotors = robot.model.rotors)
    state.rotors = rotors->later(state.rotors, command.rotors, rotors->decay(h));
  state.memory.previous_step = h;
}

template class StepperOf<unknowns>;
template class StepperOf<unknowns_with_legs>;

}  // namespace muster::simbody
