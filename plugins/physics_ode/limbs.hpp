// Limbs in ODE: bodies of their own on hinges, sliders and balls without motors.
#pragma once

#include <array>
#include <muster/limbs.hpp>

#include "library.hpp"
#include "model.hpp"

namespace muster::ode {

using description::LimbModel;

// State of a wheel or limb in ODE: a body of its own, which its joint holds only approximately. The error matters: the
// drift of a turning axle makes ODE's step second order. In the body's frame, relative to its centre of mass.
struct HungBody {
  std::array<double, 3> place;       // [m]
  std::array<double, 4> quaternion;  // all 0: not set yet, taken from its joint
  std::array<double, 3> velocity;    // [m/s]
  std::array<double, 3> spin;        // [rad/s]
};

// A rigid part of a robot, its own frame.
struct Moving {
  Eigen::Vector3d at;        // [m]
  Eigen::Matrix3d turned;    // its axes as columns
  Eigen::Vector3d velocity;  // of the frame's origin [m/s]
  Eigen::Vector3d spin;      // [rad/s]

  Eigen::Vector3d velocity_at(const Eigen::Vector3d& place) const { return velocity + spin.cross(place - at); }
};

// Pose and velocity of a limb by its joint's state.
Moving carried(const LimbModel& limb, const Limb& now, const Moving& carrier);

// The joint's state of a limb from its carrier; `before` gives the number of whole turns.
Limb hanging(const LimbModel& limb, const Limb& before, const Moving& carrier, const Moving& now);

// Joins two bodies placed as with the limb's joint at 0, with its limits, damping and friction; `carrier` is the
// carrier's pose in the world.
void join(dWorldID world, const LimbModel& limb, dBodyID body, dBodyID carrier,
          const Eigen::Isometry3d& frame_of_carrier);

}  // namespace muster::ode
