#include "cluster_stepper.hpp"

#include <algorithm>
#include <cmath>

#include "motion.hpp"

namespace muster::simbody {

using Eigen::Vector3d;

namespace {

constexpr double longest_way = 0.01;  // [m] step limit for a robot near others
constexpr int most_parts = 100;
// [s] step limit while wheels slide, or may begin to. Friction has the direction of the slip at a step's end, and slip
// that begins within a step gets the friction of all of it: errors of first order.
constexpr double longest_slide = 0.005;

// True if the commanded acceleration of the wheels needs more than half of the available friction.
bool may_slide(const RobotModel& model, const Command& command) {
  const double fastest = std::max({std::abs(command.left_rate), std::abs(command.right_rate),
                                   std::abs(command.rear_rate[0]), std::abs(command.rear_rate[1])});
  return model.has_wheels && fastest * model.drive.wheel_radius > 0.5 * model.drive.friction * gravity;
}

// True if the wheels slid in the last step.
bool slides(const RobotModel& model, const Memory& memory) {
  return std::any_of(memory.impulse.begin(), memory.impulse.end(), [&](const auto& impulse) {
    const double bound = 0.99 * model.drive.friction * impulse[0];
    return bound > 0 && impulse[1] * impulse[1] + impulse[2] * impulse[2] > bound * bound;
  });
}

int parts_within(double whole, double longest) {
  return static_cast<int>(std::clamp(std::ceil(whole / longest - 1e-9), 1.0, static_cast<double>(most_parts)));
}

}  // namespace

Extent extent_of(const RobotModel& model, const RobotState& state, double time, double room) {
  const Eigen::Quaterniond turned_by(state.pose[3], state.pose[4], state.pose[5], state.pose[6]);
  const Vector3d middle = Vector3d(state.pose[0], state.pose[1], state.pose[2]) + turned_by * model.middle;
  const Vector3d reach = Vector3d::Constant(model.reach + room * way_of(model, state, time));
  return {middle - reach, middle + reach};
}

ClusterStepper::ClusterStepper(Arena& arena) : arena_(arena), stepper_(arena) {
  if (arena.crew.any_has_many_joints()) stepper_with_legs_ = std::make_unique<StepperOf<unknowns_with_legs>>(arena);
}

Count ClusterStepper::count() const {
  Count sum = stepper_.count();
  if (stepper_with_legs_) sum += stepper_with_legs_->count();
  return sum;
}

bool ClusterStepper::move(const Cluster& cluster, const std::vector<Extent>& reach, int count, double dt,
                          const std::vector<Command>& commands, std::vector<RobotState>& states) {
  const double h = dt / count;
  for (int k = 0; k < count; ++k) {
    if (!find_groups(cluster, count > 1 ? &reach : nullptr, h, states)) return false;
    for (std::size_t g = 0; g < cluster.robots.size(); ++g) {
      const Group& group = groups_[g];
      const int parts =
          group.robots.empty() ? 0 : std::max(group.parts, parts_if_it_slides(group, h, commands, states));
      for (int part = 0; part < parts; ++part)
        advance(group, h / parts, (k + (part + 0.5) / parts) * h, commands, states);
    }
  }
  return true;
}

// A group is stored at its first robot's place. False if a robot may leave `reach`, if given, in this step.
bool ClusterStepper::find_groups(const Cluster& cluster, const std::vector<Extent>* reach, double h,
                                 const std::vector<RobotState>& states) {
  const std::size_t count = cluster.robots.size();
  extents_.clear();
  for (const int i : cluster.robots) {
    const CrewMember& robot = arena_.crew[i];
    extents_.push_back(extent_of(robot.model, states[i], h));
    if (!reach || (*reach)[i].holds(extents_.back())) continue;
    check_speed(robot.name, speed_of(robot.model, states[i]));  // otherwise no extent would suffice
    return false;
  }
  if (groups_.size() < count) groups_.resize(count);
  for (std::size_t g = 0; g < count; ++g) groups_[g].robots.clear(), groups_[g].pairs.clear(), groups_[g].walls.clear();
  connected_.begin(static_cast<int>(count));
  for (const auto& [i, j] : cluster.pairs) {
    if (extents_[i].overlaps(extents_[j])) connected_.join(i, j);
  }
  for (std::size_t i = 0; i < count; ++i)
    groups_[connected_.root(static_cast<int>(i))].robots.push_back(cluster.robots[i]);
  for (const auto& [i, j] : cluster.pairs) {
    if (extents_[i].overlaps(extents_[j]))
      groups_[connected_.root(i)].pairs.push_back({cluster.robots[i], cluster.robots[j]});
  }
  for (const auto& [i, wall] : cluster.walls) {
    if (extents_[i].overlaps(arena_.wall_extents[wall]))
      groups_[connected_.root(i)].walls.push_back({cluster.robots[i], wall});
  }
  for (std::size_t g = 0; g < count; ++g) groups_[g].parts = parts_of(groups_[g], h, states);
  return true;
}

int ClusterStepper::parts_of(const Group& group, double h, const std::vector<RobotState>& states) const {
  if (group.pairs.empty() && group.walls.empty()) return 1;
  double fast = 0;
  for (const int i : group.robots) fast = std::max(fast, speed_of(arena_.crew[i].model, states[i]));
  return parts_within(fast * h, longest_way);
}

int ClusterStepper::parts_if_it_slides(const Group& group, double h, const std::vector<Command>& commands,
                                       const std::vector<RobotState>& states) const {
  const int parts = parts_within(h, longest_slide), first = group.robots.front();
  if (group.robots.size() > 1 || parts == 1) return 1;
  const RobotModel& model = arena_.crew[first].model;
  return may_slide(model, commands[first]) || slides(model, states[first].memory) ? parts : 1;
}

void ClusterStepper::advance(const Group& group, double h, double at, const std::vector<Command>& commands,
                             std::vector<RobotState>& states) {
  const auto has_many_joints = [&](int i) { return arena_.crew[i].model.has_many_joints(); };
  if (is_in_the_air(group, h, states)) {
    const int i = group.robots.front();
    arena_.crew[i].flight->step(h, commands[i].rotors, states[i]);
    double largest = 0;
    for (const double speed : states[i].twist) largest = std::abs(speed) <= largest ? largest : std::abs(speed);
    check_speed(arena_.crew[i].name, largest);
  } else if (std::any_of(group.robots.begin(), group.robots.end(), has_many_joints)) {
    stepper_with_legs_->advance(group, h, at, commands, states);
  } else {
    stepper_.advance(group, h, at, commands, states);
  }
}

bool ClusterStepper::is_in_the_air(const Group& group, double h, const std::vector<RobotState>& states) const {
  const int i = group.robots.front();
  const CrewMember& robot = arena_.crew[i];
  if (!robot.flight || !group.pairs.empty() || !group.walls.empty()) return false;
  const Vector3d up = matrix_of(states[i]).row(2);
  return states[i].pose[2] + robot.model.lowest_point(up) > way_of(robot.model, states[i], h);
}

}  // namespace muster::simbody
