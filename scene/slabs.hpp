// Walls and their doors as what stands in the way of bodies: upright slabs.
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

// Each wall as the slabs that its open doors leave of it: the parts between them, whole, and those over them. A closed
// door is wall: so that nothing is caught at a seam, it makes none. Doors reach as far as their wall does.
std::vector<Slab> slabs(const std::vector<Wall>& walls, const std::vector<Door>& doors);

}  // namespace muster::scene
