// Whether a snapshot holds all of a run's state: what a plugin keeps outside of its tables is lost by it.
#pragma once

#include <string>

#include "kernel/simulation.hpp"

namespace muster::cli {

// The run goes on side by side with a world of its own that begins from its snapshot, until they differ: at most
// `seconds` of the clock, at most as many ticks as it has run, or some hundreds. `!= ""`: the words for a warning. Call
// it last: the run is not where it was.
std::string loss_of_snapshot(Simulation& run, const World& world, Options options, double seconds);

}  // namespace muster::cli
