// Limbs of a robot: links on hinges, sliders and balls that no motor turns. How they weigh on the rest of it, how they
// move on, and how what touches them moves it all. A ball's unknowns are the turn rate of the limb itself, not relative
// to what carries it; then its directions need no derivatives.
#pragma once

#include "block_cholesky.hpp"
#include "contact_solver.hpp"
#include "model.hpp"
#include "state.hpp"

namespace muster::simbody {

// Where limbs are and how they are turned, as the body is, in any frame; from the body's origin.
struct Posture {
  struct Place {
    Eigen::Matrix3d joint, turned;  // axes of the joint at 0, and of the limb
    Eigen::Vector3d at;             // the limb's origin [m]
  };
  Eigen::Matrix3d body;
  std::array<Place, Limbs::most> limb;
};
Posture posture_of(const RobotModel& robot, const Limbs& limbs, const Eigen::Matrix3d& body);

// How the unknowns move and turn what is fixed to a limb at `place`, from the body's origin, all in the posture's
// frame.
using ColumnsOfUnknowns = Eigen::Matrix<double, 3, unknowns_with_legs>;
struct LimbColumns {
  ColumnsOfUnknowns going, turning;
};
LimbColumns columns_at(const RobotModel& robot, const Posture& posture, int limb, const Eigen::Vector3d& place);

// M udot = force - damping u without contacts and motors, in the posture's frame, which stands still; `fall` is the
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

// Through h [s] with velocities u in the posture's frame, while the body turns to `body` in it. The posture is that of
// the limbs before, and after it that of the limbs then.
void move_limbs(const RobotModel& robot, double h, const Eigen::Matrix3d& body, const VelocityOf<unknowns_with_legs>& u,
                Posture& posture, Limbs& limbs);

// What a joint itself does while an impulse is its force times `kick` [s]: dry friction, if anything.
Motor joint_motor(const LimbModel& limb, double kick);

// At a limit, which a limb that goes at `rate` would pass within h [s], it stops, without bouncing.
void stop_at_limits(const LimbModel& limb, const Limb& now, double rate, double h, Motor& motor);

}  // namespace muster::simbody
