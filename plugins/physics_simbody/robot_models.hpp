// The robots of an engine: their constant properties, with mass matrices from Simbody.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "block_cholesky.hpp"
#include "contact_solver.hpp"
#include "engine.hpp"
#include "flight.hpp"
#include "model.hpp"

namespace muster::simbody {

struct CrewMember {
  // One rigid body except for its wheels, if it has any.
  bool is_rigid() const { return model.legs.empty() && model.limbs.empty(); }
  // Acceleration of u of such a robot, without contacts and motors, at the given attitude; without the part of its
  // origin's motion about the mass centre, which follows from the rotation of a step.
  Velocity free_acceleration(const Eigen::Matrix3d& to_world, const Velocity& u) const;
  VelocityOf<unknowns_with_legs> free_acceleration_with_four_wheels(const Eigen::Matrix3d& to_world,
                                                                    const VelocityOf<unknowns_with_legs>& u) const;

  std::string name;
  RobotModel model;
  RobotBodies bodies;
  description::Mass whole;              // wheels included
  std::array<double, 2> wheel_inertia;  // about the axle
  std::optional<Flight> flight;         // if it has rotors and no limbs
  MassMatrix mass, inverse_mass;        // without legs and limbs, with which they change in each step
  // The same of a mecanum drive, each of whose wheels has a rate of its own.
  std::optional<InertiaOf<unknowns_with_legs>> with_four_wheels;
};

class RobotModels {
 public:
  explicit RobotModels(const std::vector<NamedRobot>& robots, LegModel legs = LegModel::as_described);

  std::size_t size() const { return members_.size(); }
  CrewMember& operator[](std::size_t i) { return members_[i]; }
  const CrewMember& operator[](std::size_t i) const { return members_[i]; }
  bool any_has_many_joints() const;
  bool any_bounces() const;
  const System& system() const { return system_; }

 private:
  void read_masses();
  void read_masses_with_four_wheels();

  System system_;
  std::vector<CrewMember> members_;
};

}  // namespace muster::simbody
