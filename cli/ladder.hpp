// The fidelity ladder: one world on seven or eight channels, each with one thing more than the one before it.
#pragma once

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
// these and of a shared channel holds on their rungs; of what it does not say, the plugins' defaults. Throws Error
// where nothing models the path loss.
std::vector<Rung> ladder(const World& world, const Simulation& given);

}  // namespace muster::cli
