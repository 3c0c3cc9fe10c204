// The stepper: second order, on velocities, one small problem a robot.
//
// Velocities stand at the middle of steps: u is found for the configuration half a step ahead and carries the robot
// over the whole step, x += h N(x_mid) u. So forces act over (previous step + step) / 2, and commands are taken at
// mid-step.
#pragma once

#include "contact_solver.hpp"
#include "model.hpp"
#include "world.hpp"

namespace muster::simbody {

class Midpoint : public Engine {
 public:
  Midpoint(const std::vector<NamedRobot>& robots, double step);
  void step(double dt, const std::vector<Command>& commands, std::vector<RobotState>& states) override;

  // u of each robot without contacts and motors after `dt`, at the given configuration: for checks against Simbody's
  // own.
  Velocity free_acceleration(std::size_t robot, const Eigen::Matrix3d& to_world, const Velocity& u) const;
  const System& system() const { return system_; }

 private:
  struct Robot {
    std::string name;
    RobotModel model;
    RobotBodies bodies;
    int first_q = 0, first_u = 0;
    std::array<Eigen::Vector3d, 2> wheel_centre;  // in the body's frame
    description::Mass whole;                      // wheels included
    Eigen::Matrix3d inertia_at_origin;            // of the whole, in the body's frame
    double wheel_inertia[2];                      // about the axle
    MassMatrix mass, inverse_mass;
    Problem problem;  // kept for its memory only: filled anew in each step
  };

  void move_to_middle(double h, const std::vector<RobotState>& states);
  void advance(Robot& robot, double h, double at, const Command& command, RobotState& state);
  void set_contacts(Robot& robot, double h, double height, const Eigen::Matrix3d& to_world,
                    const RobotState& state) const;
  void read_mass(Robot& robot);

  System system_;
  std::vector<Robot> robots_;
  double longest_step_;
};

}  // namespace muster::simbody
