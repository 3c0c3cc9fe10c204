// Limbs of a robot: links on hinges, sliders and balls without motors. Their inertia on the rest of it, their motion,
// and the effect of contacts on them. A ball's unknowns are the turn rate of the limb itself, not relative to its
// carrier: then its directions need no derivatives.
#pragma once

#include "block_cholesky.hpp"
#include "contact_solver.hpp"
#include "model.hpp"
#include "state.hpp"

namespace muster::simbody {

// Positions and orientations of limbs and of the body, in any frame; from the body's origin.
struct Posture {
  struct Place {
    Eigen::Matrix3d joint, turned;  // axes of the joint at 0, and of the limb
    Eigen::Vector3d at;             // the limb's origin [m]
  };
  Eigen::Matrix3d body;
  std::array<Place, Limbs::most> limb;
};
Posture posture_of(const RobotModel& robot, const Limbs& limbs, const Eigen::Matrix3d& body);

// Velocity and turn rate, by the unknowns, of a point fixed to a limb at `place`, from the body's origin, all in the
// posture's frame.
using ColumnsOfUnknowns = Eigen::Matrix<double, 3, unknowns_with_legs>;
struct LimbColumns {
  ColumnsOfUnknowns going, turning;
};
LimbColumns columns_at(const RobotModel& robot, const Posture& posture, int limb, const Eigen::Vector3d& place);

// M udot = force - damping u without contacts and motors, in the posture's frame, fixed for the step; `fall` is the
// acceleration of free fall in it [m/s2].
struct LimbedMass {
  MassMatrixOf<unknowns_with_legs> mass, damping;
  VelocityOf<unknowns_with_legs> force;
};
LimbedMass weigh(const RobotModel& robot, const Posture& posture, const VelocityOf<unknowns_with_legs>& u,
                 const Eigen::Vector3d& fall);

// Rates of limbs as unknowns, and back.
void take_rates(const RobotModel& robot, const Posture& posture, const Limbs& limbs, VelocityOf<unknowns_with_legs>& u);
void leave_rates(const RobotModel& robot, const Posture& posture, const VelocityOf<unknowns_with_legs>& u,
                 Limbs& limbs);

// Advances h [s] with velocities u in the posture's frame, while the body turns to `body` in it. The posture is updated
// too.
void move_limbs(const RobotModel& robot, double h, const Eigen::Matrix3d& body, const VelocityOf<unknowns_with_legs>& u,
                Posture& posture, Limbs& limbs);

// Passive action of a joint as a motor: dry friction, if any. An impulse is its force times `kick` [s].
Motor joint_motor(const LimbModel& limb, double kick);

// Stops a limb at a limit that it would pass within h [s] at `rate`, without bouncing.
void stop_at_limits(const LimbModel& limb, const Limb& now, double rate, double h, Motor& motor);

}  // namespace muster::simbody
