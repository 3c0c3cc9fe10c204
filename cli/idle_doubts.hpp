// Doubts about plugins that nothing in their world can bring to act.
#pragma once

#include <string>
#include <vector>

#include "kernel/simulation.hpp"

namespace muster::cli {

// Warnings, "world.xml:8:3: ...": reflections without walls, bodies of robots without a third radio's, distances to
// radios that there are not, and what begins after the end of the run.
std::vector<std::string> idle_doubts(const Simulation& run);

// Notes in the same form, of what may be meant: walls that a model of log-distance does not count, and satellites at
// the place where no latitude and longitude is given.
std::vector<std::string> idle_notes(const Simulation& run);

}  // namespace muster::cli
