// Inputs of a backend's step: the rows of robot/*/pose, twist, wheels, rotors and drive commands, and its own memory.
#pragma once

#include <array>
#include <cstddef>
#include <muster/limbs.hpp>

namespace muster::simbody {

constexpr double gravity = 9.81;  // [m/s2]

// Commands at the tick's start and their slopes over the tick: rates of wheels, angles of legs; rotors' rates, held
// over it.
struct Command {
  double left, right;                             // [rad/s]
  double left_rate, right_rate;                   // [rad/s2]
  std::array<double, 4> rotors{};                 // front, left, back, right [rad/s]
  std::array<double, 6> leg_angle{}, leg_rate{};  // [rad], [rad/s]
  std::array<double, 2> rear{}, rear_rate{};      // wheels of a mecanum drive [rad/s], [rad/s2]
  double steering = 0, steering_rate = 0;         // of a car [rad], [rad/s]
};

// The impulse of a contact of the body, stored by the robot with the smaller row.
struct KeptImpulse {
  double id = 0;                    // of robot, wall or ground, of both shapes and their features; 0: none
  std::array<double, 3> impulse{};  // on the robot, in the world's frame [N s]
};

// Memory of the stepper beside the standard rows. The length of its last step (0: none, its velocities are those of an
// instant). Impulses of contacts, from which the search for a slipping step starts: of the wheels, and the strongest of
// the others. A lost impulse costs some iterations and changes no result.
struct Memory {
  static constexpr const char* columns =
      "previous_step[s] left_n[N*s] left_x[N*s] left_y[N*s] right_n[N*s] right_x[N*s] right_y[N*s] "
      "id1 x1[N*s] y1[N*s] z1[N*s] id2 x2[N*s] y2[N*s] z2[N*s] id3 x3[N*s] y3[N*s] z3[N*s] "
      "id4 x4[N*s] y4[N*s] z4[N*s] id5 x5[N*s] y5[N*s] z5[N*s] id6 x6[N*s] y6[N*s] z6[N*s] "
      "id7 x7[N*s] y7[N*s] z7[N*s] id8 x8[N*s] y8[N*s] z8[N*s]";
  double previous_step = 0;
  std::array<std::array<double, 3>, 2> impulse{};  // [wheel][normal, x, y of the world]
  std::array<KeptImpulse, 8> kept{};
};

struct RobotState {
  std::array<double, 7> pose;   // x y z [m], qw qx qy qz, body to world
  std::array<double, 6> twist;  // v [m/s] of the body's origin, w [rad/s]; both in the world's frame
  std::array<double, 2> angle;  // of the wheels, left and right [rad]
  std::array<double, 2> rate;   // [rad/s]
  Memory memory;
  std::array<double, 6> leg_angle{}, leg_rate{};    // in the order of the model [rad], [rad/s]
  std::array<double, 6> leg_torque{};               // of their motors, the mean over the last step [N m]
  std::array<double, 4> rotors{};                   // present rates [rad/s]
  Limbs limbs{};                                    // present states
  std::array<double, 2> rear_angle{}, rear_rate{};  // of the rear wheels of a mecanum drive [rad], [rad/s]
};

}  // namespace muster::simbody
