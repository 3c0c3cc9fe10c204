// What a backend is a function of: the rows of robot/*/pose, twist, wheels and drive, and its own memory.
#pragma once

#include <array>
#include <cstddef>

namespace muster::simbody {

constexpr double gravity = 9.81;  // [m/s2]

// Wheel rates asked for at the tick's start, and their slopes over the tick.
struct Command {
  double left, right;            // [rad/s]
  double left_rate, right_rate;  // [rad/s2]
};

// What the stepper remembers beside the standard rows: the length of its last step (0: none, its velocities stand for
// an instant), and the impulses of the wheels' contacts, from which a step in which they slip begins to search.
struct Memory {
  static constexpr const char* columns =
      "previous_step[s] left_n[N*s] left_x[N*s] left_y[N*s] right_n[N*s] right_x[N*s] right_y[N*s]";
  double previous_step = 0;
  std::array<std::array<double, 3>, 2> impulse{};  // [wheel][normal, x, y of the world]
};

struct RobotState {
  std::array<double, 7> pose;   // x y z [m], qw qx qy qz, body to world
  std::array<double, 6> twist;  // v [m/s] of the body's origin, w [rad/s]; both in the world's frame
  std::array<double, 2> angle;  // of the wheels, left and right [rad]
  std::array<double, 2> rate;   // [rad/s]
  Memory memory;
};

}  // namespace muster::simbody
