// The fidelity ladder: one world on seven or eight channels, each with one thing more than the one before it; and with
// bodies from kinematic to measured.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "kernel/simulation.hpp"

namespace muster::cli {

struct Rung {
  std::string name;    // "multi_wall"
  std::string change;  // what makes it, in the world file's words: radio.multiwall model="multi_wall"
  World world;
};

// From a perfect channel up to contention, as far as the world has what a rung needs: only where messages are sent can
// they contend. `given` is the world as its file has it, made: what its instances claim and which parameters they have
// tells what shadows, what fades and what else adds to a link's level, whatever their names. What its file says of all
// these and of a shared channel holds on their rungs; of what it does not say, the plugins' defaults. Empty where
// nothing models the path loss.
std::vector<Rung> ladder(const World& world, const Simulation& given);

// The world with its own channel, and bodies that follow their wheels in the plane, roll without slip, slip within the
// bounds of friction and torque, and, if there is a log, move as it says. Some may not run: the plugins say of which
// robots. Empty where the world has no physics.
std::vector<Rung> ladder_of_bodies(const World& world, const Simulation& given, const std::filesystem::path& log);

}  // namespace muster::cli
