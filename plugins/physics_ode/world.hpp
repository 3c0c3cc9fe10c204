// Robots in an ODE world, as a function of inputs: pose, twist, wheels, hinge errors and commands. Bodies are set from
// them before each step, so a remade world does the same arithmetic, bit for bit.
#pragma once

#include <array>
#include <deque>
#include <string>
#include <vector>

#include "library.hpp"
#include "limbs.hpp"
#include "model.hpp"
#include "plugins/rigid_states.hpp"
#include "scene/slabs.hpp"

namespace muster::ode {

constexpr double gravity = 9.81;  // [m/s2]

inline Eigen::Vector3d vector(const dReal* values) { return {values[0], values[1], values[2]}; }
inline Eigen::Quaterniond quaternion(const dReal* values) { return {values[0], values[1], values[2], values[3]}; }

struct Settings {
  double step = 0.001;           // the longest inside a tick [s]
  bool quick = false;            // dWorldQuickStep instead of dWorldStep
  int iterations = 50;           // of it
  double over_relaxation = 1.3;  // of it
  double erp = 0.2;              // share of a joint's or contact's error corrected per step
  double cfm = 1e-10;            // softness of joints and contacts
  double friction = 0.3;         // of bodies, with walls, robots and ground
  bool obstacles = true;         // walls and other robots stop a robot

  bool operator==(const Settings& b) const {
    return step == b.step && quick == b.quick && iterations == b.iterations && over_relaxation == b.over_relaxation &&
           erp == b.erp && cfm == b.cfm && friction == b.friction && obstacles == b.obstacles;
  }
};

using rigid::Command;
using rigid::NamedRobot;

struct RobotState : rigid::RobotState {
  std::array<HungBody, 2> hinged{};  // of the first wheel of each side; the others are set by their hinges in each tick
  std::array<HungBody, Limbs::most> hung{};
  std::array<HungBody, 2> rear_hinged{};  // of the rear wheels of a mecanum drive
};

class World {
 public:
  // Throws std::runtime_error for a robot that it cannot model.
  World(const std::vector<NamedRobot>& robots, const Settings& settings);

  void set_walls(const std::vector<scene::Slab>& walls);

  // Steps from t to t + dt [s]; one command and one state a robot, in the order of the robots. `seed`: of quick steps.
  // Returns the number of ODE's complaints. Throws std::runtime_error naming the robot whose motion is no longer
  // finite.
  int step(double dt, const std::vector<Command>& commands, std::vector<RobotState>& states, unsigned long seed);

 private:
  struct Robot {
    std::string name;
    RobotModel model;
    dBodyID body = nullptr;
    std::vector<dBodyID> wheel{};
    std::vector<dJointID> hinge{}, motor{};  // the motor of a wheel that follows another is the chain to that
    std::array<dBodyID, Limbs::most> limb{};
    std::array<dGeomID, 2> steered{};  // wheels of a car
  };
  struct Surface {
    std::size_t number;  // in the order in which shapes were added
    double friction, restitution;
    // Of one of more than two wheels, else 0: its contact's spring and damper along the normal [N/m], [N s/m], and
    // friction's bound under its share of the weight [N].
    double stiffness = 0, damping = 0, grip = 0;
    // Of a roller or a free wheel: friction acts along this direction of the frame's body only, else null.
    dBodyID frame = nullptr;
    Eigen::Vector3d along = Eigen::Vector3d::Zero();
  };
  struct Pair {
    dGeomID a, b;
    const Surface *first, *second;  // of a and b, a's number below b's
    bool operator<(const Pair& o) const {
      return first != o.first ? first->number < o.first->number : second->number < o.second->number;
    }
  };

  void add(Robot& robot);
  void add_wheel(Robot& robot, std::size_t w) const;
  dBodyID add_body(const description::Mass& mass, const Eigen::Isometry3d& frame) const;
  void add_shapes(Robot& robot, const std::vector<Eigen::Isometry3d>& limbs);
  dGeomID add_geom(dGeomID geom, unsigned long category, unsigned long meets, double friction, double restitution);
  static void place(const Robot& robot, const RobotState& state);
  void ask(const Robot& robot, const Command& command, double at) const;
  static void steer(const Robot& robot, double angle);
  void soften(const Robot& robot, double share);
  static void lift(const Robot& robot, const Command& command, double h, RobotState& state);
  void touch();
  void touch(const Pair& pair);
  void advance(double h, unsigned long seed);
  static void read(const Robot& robot, RobotState& state);
  static void read_limbs(const Robot& robot, RobotState& state);
  void carry_and_slip(const Pair& pair, dContact& contact) const;
  static void hold(const Surface& wheel, dContact& contact);
  static void near(void* world, dGeomID a, dGeomID b);

  Library library_;
  Settings settings_;
  OwnThread thread_;
  std::unique_ptr<dxWorld, Destroy> world_;
  std::unique_ptr<dxSpace, Destroy> space_;
  std::unique_ptr<dxJointGroup, Destroy> contacts_;
  std::vector<Robot> robots_;
  std::deque<Surface> surfaces_;  // targets of the shapes' user pointers
  std::vector<dGeomID> walls_;
  std::size_t surfaces_of_robots_ = 0;
  double h_ = 0;  // length of the present step [s]
  std::vector<Pair> pairs_;
};

}  // namespace muster::ode
