// Doubts about the terms of the channel: what counts twice, and what nothing counts.
#pragma once

#include <string>
#include <vector>

#include "kernel/simulation.hpp"

namespace muster::cli {

// Warnings, "world.xml:8:3: ...": one for each two instances that add the same to link/*/level (two path losses, two
// shadowings, one plugin twice with the same words); and one where all that add to it are none that a path loss is of.
std::vector<std::string> level_doubts(const Simulation& run);

}  // namespace muster::cli
