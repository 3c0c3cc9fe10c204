// Legs of a walking robot: their inertia on its body, their motors' control, and their contacts.
#pragma once

#include "contact_solver.hpp"
#include "model.hpp"
#include "state.hpp"

namespace muster::simbody {

using LegAngles = std::array<double, description::LegDrive::count>;

// Mass matrix, and forces of gravity and of motion: M udot = force without contacts and motors. All in the body's
// frame, fixed for the step; `fall` is the acceleration of free fall in it [m/s2].
struct LeggedMass {
  MassMatrixOf<unknowns_with_legs> mass;
  VelocityOf<unknowns_with_legs> force;
};
LeggedMass weigh(const RobotModel& robot, const LegAngles& angle, const VelocityOf<unknowns_with_legs>& u,
                 const Eigen::Vector3d& fall);

// Its inverse: legs are coupled with the body but not with each other.
MassMatrixOf<unknowns_with_legs> inverse(const MassMatrixOf<unknowns_with_legs>& mass);

// The controller of a leg over a step of length h [s], as the motor of a joint: torque is position_gain times the error
// of the angle plus rate_gain times that of the rate, both at mid-step, within the limits. `asked` [rad] is at
// mid-step.
Motor leg_motor(const description::LegDrive& drive, double asked, double asked_rate, double angle, double h);

// Contact of a leg with a solid, present or imminent: at most at two places, with marks 0 and 1. `ahead` and `above`
// are the leg's own x and z axes in the world, the hip is in the world as well.
struct LegTouch {
  TouchPoint point;
  Eigen::Vector3d normal;  // to the leg
};
struct LegTouches {
  int count = 0;
  std::array<LegTouch, 2> touch;
};
LegTouches touch_leg(const Eigen::Vector3d& hip, const Eigen::Vector3d& ahead, const Eigen::Vector3d& above,
                     double radius, const Solid& solid, double margin);

}  // namespace muster::simbody
