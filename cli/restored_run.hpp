// A run that begins from a file of `run --save`.
#pragma once

#include <string>

#include "kernel/simulation.hpp"

namespace muster::cli {

// Warns of what the world file says now and the snapshot does not: it is not taken. With a seed of its own it notes
// from when on that counts. Throws Error.
void restore(Simulation& run, const std::string& file, bool has_seed);

// Throws Error where the restored run stands after its end, and notes where it is at it and ticks are wanted.
void check_end(const Simulation& run, const std::string& file, bool is_expected);

// Throws Error where the restored run is past a swap that the command plans, and has not had it.
void check_swap(const Simulation& run, const std::string& file, const Occasion& swap);

}  // namespace muster::cli
