// A world's walls and doors, as geometry and as a picture.
#pragma once

#include "kernel/simulation.hpp"
#include "plotting/layers.hpp"
#include "scene/walls.hpp"

namespace muster {

// Walls and doors numbered as their rows. Throws std::runtime_error that names the row at fault.
scene::Scene scene_of(const Simulation& run);

// Walls, doors, and the radios that do not move.
plotting::FloorPlan plan_of(const Simulation& run);

}  // namespace muster
