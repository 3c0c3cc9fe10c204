// Limbs in ODE: bodies of their own on hinges, sliders and balls that no motor turns.
#pragma once

#include <array>
#include <muster/limbs.hpp>

#include "library.hpp"
#include "model.hpp"

namespace muster::ode {

using description::LimbModel;

// A wheel or limb as ODE has it: a body of its own, which a joint holds only nearly. What it is off by matters: the
// drift of an axle that turns is what makes ODE's step of second order. In the body's frame, relative to its centre of
// mass.
struct HungBody {
  std::array<double, 3> place;       // [m]
  std::array<double, 4> quaternion;  // all 0: not known yet, as its joint wants it
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

// Where its joint wants a limb that hangs as it says.
Moving carried(const LimbModel& limb, const Limb& now, const Moving& carrier);

// How a limb hangs, by what carries it; `before` says how many turns it has made.
Limb hanging(const LimbModel& limb, const Limb& before, const Moving& carrier, const Moving& now);

// Joins two bodies that stand where the limb's joint is at 0, with its limits, damping and friction; `carrier` is where
// that stands in the world.
void join(dWorldID world, const LimbModel& limb, dBodyID body, dBodyID carrier,
          const Eigen::Isometry3d& frame_of_carrier);

}  // namespace muster::ode
