// A run that begins from a file of `run --save`.
#pragma once

#include <string>

#include "kernel/simulation.hpp"

namespace muster::cli {

// Warns of what the world file says now and the snapshot does not: it is not taken. With a seed of its own it notes
// from when on that counts. Throws Error.
void restore(Simulation& run, const std::string& file, bool has_seed);

}  // namespace muster::cli
