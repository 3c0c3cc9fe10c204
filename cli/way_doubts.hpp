// Doubts about the way points of robots on the ground.
#pragma once

#include <string>
#include <vector>

#include "kernel/simulation.hpp"

namespace muster::cli {

// Warnings, "way.csv:2:1: ...", of control.waypoint and control.strafe: way points where no robot comes in the run, a
// tolerance at which each is reached from the start, and pieces of the way that lead through a wall which stops robots.
std::vector<std::string> way_doubts(const Simulation& run);

}  // namespace muster::cli
