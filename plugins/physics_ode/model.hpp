// ODE's model of a robot: a rigid body; wheels hinged to it, rotors that lift it, or no drive; and its collision
// shapes.
#pragma once

#include <string>
#include <vector>

#include "description/robot.hpp"

namespace muster::ode {

// A sphere fixed to the body, which slides on it without friction if driven, or to a limb.
struct Ball {
  Eigen::Vector3d centre;  // in the frame of its carrier [m]
  double radius;           // [m]
  int limb = -1;           // -1: the body
};

// A box fixed to the body or a limb.
struct Block {
  Eigen::Isometry3d pose;  // in the frame of its carrier
  Eigen::Vector3d size;    // full edges [m]
  bool is_wheel;           // it represents a wheel among obstacles and does not turn; the ground touches its sphere
  int limb = -1;           // -1: the body
};

struct Wheel {
  int side;                 // 0 left, 1 right
  description::Mass mass;   // in the joint's frame
  Eigen::Isometry3d frame;  // of the joint in the body's
  Eigen::Vector3d axis;     // unit, in the joint's frame
};

struct RobotModel {
  // Throws std::runtime_error with everything that this backend lacks for the robot.
  explicit RobotModel(const description::Robot& robot);

  bool is_driven = true;
  bool has_wheels = true;  // false: the wheels' fields below are unused
  description::DifferentialDrive drive;
  std::optional<description::Quadrotor> rotors;
  double restitution = 0;
  double mass = 0;            // of all parts [kg]
  description::Mass body;     // mass of the root and all that is fixed to it, in its frame
  std::vector<Wheel> wheels;  // the first of each side, then those that follow them
  std::vector<description::LimbModel> limbs;
  std::vector<Ball> balls;
  std::vector<Block> blocks;

 private:
  void take_shapes(const description::Robot& robot, std::size_t link, int limb);
};

}  // namespace muster::ode
