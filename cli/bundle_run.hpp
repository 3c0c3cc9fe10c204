// The run of a bundle: a world from its start to its end, with digests on the way.
#pragma once

#include <string>
#include <vector>

#include "bundle/manifest.hpp"
#include "kernel/simulation.hpp"

namespace muster::cli {

// Before the first tick, after 1, 2, 4, 8 ... ticks and at the end: what differs from the start on shows in its table
// before it has spread. Throws Error, also where it is interrupted.
std::vector<bundle::Waymark> waymarks_of(Simulation& run, const std::string& title);

}  // namespace muster::cli
