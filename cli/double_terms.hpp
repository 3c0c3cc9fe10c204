// Terms of the channel that count the same twice.
#pragma once

#include <string>
#include <vector>

#include "kernel/simulation.hpp"

namespace muster::cli {

// A warning for each two instances that add the same to link/*/level: two path losses, two shadowings, one plugin
// twice with the same words. "world.xml:8:3: ...".
std::vector<std::string> double_terms(const Simulation& run);

}  // namespace muster::cli
