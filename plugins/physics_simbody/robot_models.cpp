#include "robot_models.hpp"

#include <algorithm>
#include <limits>

namespace muster::simbody {

using Eigen::Matrix3d;
using Eigen::Vector3d;

RobotModels::RobotModels(const std::vector<NamedRobot>& robots, LegModel legs) {
  for (const NamedRobot& named : robots) {
    CrewMember robot{named.name, RobotModel(*named.description), {}, {}, {}, {}, {}, {}, {}};
    if (legs == LegModel::rigid) robot.model.leg_drive.stiffness = std::numeric_limits<double>::infinity();
    robot.bodies = system_.add(robot.model);
    robot.whole = whole_mass(*named.description);
    for (std::size_t w = 0; w < 2; ++w) robot.wheel_inertia[w] = robot.model.wheel[w].inertia(2, 2);
    for (const FollowingWheel& follower : robot.model.followers)
      robot.wheel_inertia[static_cast<std::size_t>(follower.side)] += follower.mass.inertia(2, 2);
    if (robot.model.rotors && robot.model.limbs.empty()) robot.flight.emplace(robot.whole, *robot.model.rotors);
    members_.push_back(std::move(robot));
  }
  system_.finish();
  system_.system.realize(system_.state, SimTK::Stage::Position);
  read_masses();
  read_masses_with_four_wheels();
}

bool RobotModels::any_has_many_joints() const {
  return std::any_of(members_.begin(), members_.end(), [](const CrewMember& m) { return m.model.has_many_joints(); });
}

bool RobotModels::any_bounces() const {
  return std::any_of(members_.begin(), members_.end(), [](const CrewMember& m) { return m.model.restitution > 0; });
}

// Simbody's own mass matrix at the reference pose; in the body's frame it is constant, as wheels are balanced. Robots
// are not joined, so one product has a column of each. Wheels of one side turn at one rate: its column is the sum of
// theirs, its row too. Missing wheels have an inertia of one and no torque.
void RobotModels::read_masses() {
  const SimTK::State& state = system_.state;
  SimTK::Vector columns;
  for (int c = 0; c < unknowns; ++c) {
    SimTK::Vector units(state.getNU(), 0.0);
    const auto has = [c](const CrewMember& robot) { return c < 6 || robot.model.has_wheels; };
    for (const CrewMember& robot : members_) {
      if (!has(robot)) continue;
      const int first = robot.bodies.body.getFirstUIndex(state);
      units[first + c] = 1;
      for (std::size_t f = 0; f < robot.model.followers.size(); ++f) {
        if (robot.model.followers[f].side == c - 6) units[first + unknowns + static_cast<int>(f)] = 1;
      }
    }
    system_.matter.multiplyByM(state, units, columns);
    for (CrewMember& robot : members_) {
      const int first = robot.bodies.body.getFirstUIndex(state), own = robot.model.has_wheels ? unknowns : 6;
      robot.mass.col(c).setZero();
      robot.mass(c, c) = 1;
      for (int r = 0; has(robot) && r < own; ++r) robot.mass(r, c) = columns[first + r];
      for (std::size_t f = 0; has(robot) && f < robot.model.followers.size(); ++f)
        robot.mass(6 + robot.model.followers[f].side, c) += columns[first + unknowns + static_cast<int>(f)];
    }
  }
  for (CrewMember& robot : members_) robot.inverse_mass = robot.mass.inverse();
}

// The four wheels' pins come right after the body, in the order of their numbers.
void RobotModels::read_masses_with_four_wheels() {
  const SimTK::State& state = system_.state;
  SimTK::Vector columns;
  constexpr int own = 6 + 4;
  for (CrewMember& robot : members_) {
    if (!robot.model.has_wheels || !robot.model.drive.mecanum) continue;
    const int first = robot.bodies.body.getFirstUIndex(state);
    auto& inertia = robot.with_four_wheels.emplace();
    inertia.mass.setIdentity();
    for (int c = 0; c < own; ++c) {
      SimTK::Vector units(state.getNU(), 0.0);
      units[first + c] = 1;
      system_.matter.multiplyByM(state, units, columns);
      for (int r = 0; r < own; ++r) inertia.mass(r, c) = columns[first + r];
    }
    inertia.inverse = inertia.mass.inverse();
  }
}

VelocityOf<unknowns_with_legs> CrewMember::free_acceleration_with_four_wheels(
    const Matrix3d& to_world, const VelocityOf<unknowns_with_legs>& u) const {
  const Vector3d w = u.head<3>(), weight = to_world.transpose() * Vector3d(0, 0, -gravity * whole.mass);
  Vector3d spin = Vector3d::Zero();
  for (int k = 0; k < 4; ++k) spin += model.wheel_inertia_of(k) * u[6 + k] * Vector3d::UnitY();
  VelocityOf<unknowns_with_legs> force = VelocityOf<unknowns_with_legs>::Zero();
  force.head<3>() = whole.centre.cross(weight) - w.cross(whole.inertia * w + spin);
  force.segment<3>(3) = weight;
  return with_four_wheels->inverse * force;
}

Velocity CrewMember::free_acceleration(const Matrix3d& to_world, const Velocity& u) const {
  const Vector3d w = u.head<3>();
  const Vector3d axle = Vector3d::UnitY();
  const Vector3d weight = to_world.transpose() * Vector3d(0, 0, -gravity * whole.mass);
  const Vector3d spin = (wheel_inertia[0] * u[6] + wheel_inertia[1] * u[7]) * axle;
  Velocity force = Velocity::Zero();
  force.head<3>() = whole.centre.cross(weight) - w.cross(whole.inertia * w + spin);
  force.segment<3>(3) = weight;
  return inverse_mass.lazyProduct(force);
}

}  // namespace muster::simbody
