// Walls and their doors as obstacles for bodies: upright slabs.
#pragma once

#include <vector>

#include "scene/walls.hpp"

namespace muster::scene {

// A box turned about z. Its own x runs along the wall.
struct Slab {
  double x = 0, y = 0, z = 0;                    // its middle [m]
  double cos_yaw = 1, sin_yaw = 0;               // of its x axis, from east to north
  double length = 0, thickness = 0, height = 0;  // full [m]
  int wall = 0;
};

// Splits each wall into slabs around its open doors: whole parts between them, and parts above them. A closed door is
// wall and makes no seam, which could catch a body. Doors end where their wall does.
std::vector<Slab> slabs(const std::vector<Wall>& walls, const std::vector<Door>& doors);

}  // namespace muster::scene
