// Robots as MuJoCo simulates them, and the text in which it reads them.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "plugins/rigid_parts.hpp"
#include "scene/slabs.hpp"

namespace muster::mujoco {

using rigid::RobotModel;
using rigid::Wheel;

constexpr double gravity = 9.81;  // [m/s2]

// Throws std::runtime_error with everything that this backend lacks for the robot.
RobotModel model_of(const description::Robot& robot);

// What MuJoCo knows of a shape is its place: how it touches others is decided here.
struct Surface {
  static constexpr int nobody = -1;

  int robot = nobody;            // index; nobody: ground or wall
  double friction, restitution;  // of a pair the smaller ones count
  bool holds_along = false;      // of a roller or a free wheel: friction acts only along `along`, in the body's frame
  double carries = 0;            // of one of more than two wheels: its share of the robot's mass [kg]
  int steered = nobody;          // a car's front wheel: 0 left, 1 right
  Eigen::Vector3d along = Eigen::Vector3d::Zero();
};

struct Surroundings {
  double friction = 0.3;  // of bodies
  bool obstacles = true;  // walls and robots stop a robot
  std::vector<scene::Slab> walls;
};

// Room for contacts and for rows of constraints in a step.
struct Room {
  int contacts = 0, rows = 0;
};

// A world in MuJoCo's own format. Bodies are called r1 (robot 1), r1w0 (its wheel 0) and r1l0 (its limb 0), shapes g0,
// g1 ... as in `surfaces`.
struct Text {
  std::string mjcf;
  std::vector<Surface> surfaces;
};
Text text_of(const std::vector<RobotModel>& robots, const Surroundings& around, const Room& room);

std::string body_name(std::size_t robot);
std::string wheel_name(std::size_t robot, std::size_t wheel);
std::string limb_name(std::size_t robot, std::size_t limb);

// Rows of the constraints of joints, and contacts that the robots have when each stands alone.
Room room_for(const std::vector<RobotModel>& robots);

}  // namespace muster::mujoco
