// The walls of a world that stand in a robot's way, from its tables.
#pragma once

#include <muster/plugin.hpp>
#include <vector>

#include "plugins/scene_rows.hpp"
#include "roadmap/obstacles.hpp"
#include "scene/slabs.hpp"

namespace muster::roadmap {

enum class Doors { as_they_stand, open };

// Of heights: what of a wall is wholly below the first or above the second is in nobody's way, such as that over a
// door.
struct Heights {
  double from, to;  // [m]
};

template <class Walls, class Shapes, class States>
std::vector<Block> blocks_of(const Walls& walls, const Shapes& shapes, const States& states, Doors doors,
                             const Heights& heights) {
  auto of_scene = scene_doors(shapes, states, walls);
  if (doors == Doors::open) {
    for (scene::Door& door : of_scene) door.open = true;
  }
  std::vector<Block> result;
  for (const scene::Slab& s : scene::slabs(scene_walls(walls), of_scene)) {
    if (s.z + s.height / 2 <= heights.from || s.z - s.height / 2 >= heights.to) continue;
    const double x = s.length / 2 * s.cos_yaw, y = s.length / 2 * s.sin_yaw;
    result.push_back({{s.x - x, s.y - y}, {s.x + x, s.y + y}, s.thickness});
  }
  return result;
}

}  // namespace muster::roadmap
