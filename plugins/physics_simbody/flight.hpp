// A robot in the air without contacts: weight and rotors on a rigid body, by the classical Runge-Kutta method of fourth
// order. Rotors' rates are known in closed form. Over a step the method takes parabolas with the same first three
// moments (means, slopes and curvatures), so a step may be much longer than their lag.
#pragma once

#include "description/robot.hpp"
#include "state.hpp"

namespace muster::simbody {

class Flight {
 public:
  Flight(const description::Mass& whole, const description::Quadrotor& drive);

  // Steps from t to t + h [s] with constant commands of the rotors. Afterwards velocities are those of the instant.
  void step(double h, const description::RotorRates& asked, RobotState& state);

  // Rotors' rates and their squares, each as a value or as a parabola's.
  struct Spin {
    description::RotorRates rates, squares;
  };
  static Spin spin(const description::RotorRates& rates);

  // Rates of change of the velocity of the centre of mass, in the world's frame, and of the turn rate, in the body's.
  struct Change {
    Eigen::Vector3d v, w;
  };
  Change change(const Eigen::Matrix3d& to_world, const Eigen::Vector3d& v, const Eigen::Vector3d& w,
                const Spin& spin) const;

 private:
  struct Motion;
  // At the start, middle and end of a step.
  using Nodes = std::array<double, 3>;
  // Values that depend on the step's length alone, cached: the rotors' decay towards their commands, and the parabolas
  // of that and of its square.
  struct Decay {
    double h = 0;
    description::RotorDecay end;
    Nodes up, up_squared, down, down_squared;
  };

  static Nodes parabola_of_decay(double k);
  void set_decay(double h);
  Motion rate(const Motion& at, const Spin& spin) const;
  std::array<Spin, 3> parabolas(const description::RotorRates& now, const description::RotorRates& asked) const;

  description::Quadrotor drive_;
  double mass_;
  Eigen::Vector3d centre_;  // of mass, in the body's frame
  Eigen::Matrix3d inertia_, inverse_inertia_;
  Decay decay_;
};

}  // namespace muster::simbody
