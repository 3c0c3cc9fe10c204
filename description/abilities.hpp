// Abilities that robots need of a physics backend, and those that it has: a backend that lacks any refuses the world
// with the list.
#pragma once

#include <string>

#include "description/robot.hpp"

namespace muster::description {

enum class Ability : unsigned {
  wheels = 1,   // two driven wheels on the ground
  rotors = 2,   // thrust of four rotors
  height = 4,   // height changes
  tilting = 8,  // roll and pitch change
  legs = 16,    // six half circles on motors, with springs
  bouncing = 512,
  pushed = 1024,    // moved by other bodies only
  steering = 2048,  // two more wheels that steer
  mecanum = 4096,   // four wheels with rollers
  // Limbs: bodies on joints without a motor.
  hinges = 32,   // revolute, continuous
  sliders = 64,  // prismatic
  balls = 128,
  loose = 256,  // planar, floating
};

constexpr Ability operator|(Ability a, Ability b) {
  return static_cast<Ability>(static_cast<unsigned>(a) | static_cast<unsigned>(b));
}

// The abilities of the backend that has most, which messages of the others name.
inline constexpr Ability abilities_of_simbody =
    Ability::wheels | Ability::steering | Ability::mecanum | Ability::rotors | Ability::legs | Ability::height |
    Ability::tilting | Ability::hinges | Ability::sliders | Ability::balls | Ability::bouncing | Ability::pushed;

// The abilities that the robot needs and `have` lacks, in words and with commas between; "" if none.
std::string lacking(const Robot& robot, Ability have);

}  // namespace muster::description
