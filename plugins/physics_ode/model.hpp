// What of a robot ODE is given: a rigid body, two wheels that hinge on it or rotors that lift it or nothing that drives
// it, and shapes that touch.
#pragma once

#include <string>
#include <vector>

#include "description/robot.hpp"

namespace muster::ode {

// A sphere fixed to the body, on which it slides smoothly where it is driven, or to a limb.
struct Ball {
  Eigen::Vector3d centre;  // in the frame of what it is fixed to [m]
  double radius;           // [m]
  int limb = -1;           // -1: the body
};

// A box fixed to the body or a limb.
struct Block {
  Eigen::Isometry3d pose;  // in the frame of what it is fixed to
  Eigen::Vector3d size;    // full edges [m]
  bool is_wheel;           // it stands for a wheel among obstacles, where it does not turn; the ground feels its sphere
  int limb = -1;           // -1: the body
};

struct Wheel {
  description::Mass mass;   // in the joint's frame
  Eigen::Isometry3d frame;  // of the joint in the body's
  Eigen::Vector3d axis;     // unit, in the joint's frame
};

struct RobotModel {
  // Throws std::runtime_error that lists all that this backend lacks for the robot.
  explicit RobotModel(const description::Robot& robot);

  bool is_driven = true;
  bool has_wheels = true;  // else what is said of them below is nothing
  description::DifferentialDrive drive;
  std::optional<description::Quadrotor> rotors;
  double restitution = 0;
  description::Mass body;  // all that is rigid with the root, in its frame
  std::array<Wheel, 2> wheel;
  std::vector<description::LimbModel> limbs;
  std::vector<Ball> balls;
  std::vector<Block> blocks;

 private:
  void take_shapes(const description::Robot& robot, std::size_t link, int limb);
};

}  // namespace muster::ode
