// Robots in a MuJoCo world, as a function of inputs: pose, twist, joints and commands. All of MuJoCo's state is set
// from them before each step, so a remade world does the same arithmetic, bit for bit.
#pragma once

#include <array>
#include <muster/limbs.hpp>
#include <string>
#include <vector>

#include "library.hpp"
#include "model.hpp"
#include "plugins/rigid_states.hpp"
#include "scene/slabs.hpp"

namespace muster::mujoco {

struct Settings {
  double step = 0.001;    // the longest inside a tick [s]
  int iterations = 100;   // of MuJoCo's solver, at most
  double friction = 0.3;  // of bodies, with walls, robots and ground
  bool obstacles = true;  // walls and other robots stop a robot

  bool operator==(const Settings& b) const {
    return step == b.step && iterations == b.iterations && friction == b.friction && obstacles == b.obstacles;
  }
};

using rigid::Command;
using rigid::NamedRobot;
using rigid::RobotState;

class World {
 public:
  // Throws std::runtime_error for a robot that it cannot model. `room` is made larger where it does not do; without
  // rows, it is that of the robots each by itself.
  World(const std::vector<NamedRobot>& robots, const Settings& settings, const Room& room = {});

  void set_walls(const std::vector<scene::Slab>& walls);

  // Steps from t to t + dt [s]; one command and one state a robot, in the order of the robots. Returns the first of
  // MuJoCo's warnings, "" if there are none. Throws std::runtime_error naming the robot whose motion is no longer
  // finite.
  std::string step(double dt, const std::vector<Command>& commands, std::vector<RobotState>& states);

  const Room& room() const { return room_; }

 private:
  // Where a joint's coordinates and rates are in MuJoCo's vectors.
  struct Joint {
    int position = 0, rate = 0;
  };
  struct Robot {
    std::string name;
    RobotModel model;
    int body = 0;  // MuJoCo's number
    Joint free{};
    std::vector<Joint> wheel{}, limb{};
    std::array<int, 2> steered{};  // shapes of a car's front wheels
  };
  // The room for contacts or constraints is used up.
  struct Full {};

  void build();
  Joint joint_of(const std::string& body) const;
  std::string step_in_room(double dt, const std::vector<Command>& commands, std::vector<RobotState>& states);
  void place(const Robot& robot, const RobotState& state);
  void ask(const Robot& robot, const Command& command, double at);
  void steer(const Robot& robot, double angle);
  void lift(const Robot& robot, const Command& command, double h, RobotState& state);
  void read(const Robot& robot, RobotState& state) const;
  void move(double h);
  // The step's contacts and constraints (world_contacts.cpp).
  void touch();
  bool keep(mjContact& contact) const;
  void let_roll();
  void hold(const Surface& wheel, mjContact& contact) const;
  void aim(double h);
  void aim_contact(mjContact& contact, double h);
  void soften(mjContact& contact, double gap, double h);
  void solve(double h);
  const Surface& surface(int geom) const { return text_.surfaces[shape_of_[static_cast<std::size_t>(geom)]]; }

  Library library_;
  Settings settings_;
  std::vector<Robot> robots_;
  std::vector<scene::Slab> walls_;
  Room room_;
  Text text_;
  Model model_;
  Data data_;
  std::vector<std::size_t> shape_of_;           // of MuJoCo's geoms: indices of surfaces
  std::vector<double> wanted_;                  // rates of motors [rad/s], by MuJoCo's degrees of freedom
  std::vector<double> start_, passive_, bias_;  // of a step: MuJoCo's coordinates, and forces of the motion
  std::vector<int> slipping_;                   // contacts with friction in the present step
};

}  // namespace muster::mujoco
