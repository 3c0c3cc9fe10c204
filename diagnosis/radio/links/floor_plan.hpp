// Converts a world's walls and doors to scene geometry and to a figure.
#pragma once

#include "kernel/simulation.hpp"
#include "plotting/layers.hpp"
#include "scene/walls.hpp"

namespace muster {

// Walls and doors numbered as their rows. Throws std::runtime_error with the row at fault.
scene::Scene scene_of(const Simulation& run);

// Walls, doors, and the radios that do not move.
plotting::FloorPlan plan_of(const Simulation& run);

}  // namespace muster
