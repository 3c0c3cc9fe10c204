// A robot in the air that touches nothing: weight and rotors on a rigid body, by the classical Runge-Kutta method of
// fourth order. Rotors' rates are known in closed form, so that they cost no accuracy.
#pragma once

#include "description/robot.hpp"
#include "state.hpp"

namespace muster::simbody {

class Flight {
 public:
  Flight(const description::Mass& whole, const description::Quadrotor& drive);

  // From t to t + h [s]; rotors are asked for the same rates all the way. Velocities stand for instants afterwards.
  void step(double h, const description::RotorRates& asked, RobotState& state) const;

  // Rates of change of the velocity of the centre of mass, in the world's frame, and of the turn rate, in the body's.
  struct Change {
    Eigen::Vector3d v, w;
  };
  Change change(const Eigen::Matrix3d& to_world, const Eigen::Vector3d& v, const Eigen::Vector3d& w,
                const description::RotorRates& rates) const;

 private:
  struct Motion;
  Motion rate(const Motion& at, const description::RotorRates& rates) const;

  description::Quadrotor drive_;
  double mass_;
  Eigen::Vector3d centre_;  // of mass, in the body's frame
  Eigen::Matrix3d inertia_, inverse_inertia_;
};

}  // namespace muster::simbody
