// What an engine of rigid bodies is given of a robot and gives back, in every tick.
#pragma once

#include <array>
#include <muster/limbs.hpp>
#include <string>

#include "description/robot.hpp"

namespace muster::rigid {

// Commanded wheel rates at the tick's start, and their slopes over the tick; rotors' rates held over it.
struct Command {
  double left, right;                         // [rad/s]
  double left_rate, right_rate;               // [rad/s2]
  std::array<double, 4> rotors{};             // front, left, back, right [rad/s]
  std::array<double, 2> rear{}, rear_rate{};  // wheels of a mecanum drive [rad/s], [rad/s2]
  double steering = 0, steering_rate = 0;     // of a car [rad], [rad/s]
};

struct RobotState {
  std::array<double, 7> pose{};    // x y z [m], qw qx qy qz, body to world
  std::array<double, 6> twist{};   // v [m/s] of the body's origin, w [rad/s]; both in the world's frame
  std::array<double, 2> angle{};   // of the wheels, left and right [rad]
  std::array<double, 2> rate{};    // [rad/s]
  std::array<double, 4> rotors{};  // present rates [rad/s]
  Limbs limbs{};                   // present states
  std::array<double, 2> rear_angle{}, rear_rate{};  // of the rear wheels of a mecanum drive
};

struct NamedRobot {
  std::string name;
  const description::Robot* description;
};

}  // namespace muster::rigid
