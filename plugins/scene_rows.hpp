// Converts rows of walls, doors and floors, of a table or a vector, to those of the scene, with the same numbers.
#pragma once

#include <muster/floors.hpp>
#include <muster/plugin.hpp>
#include <scene/walls.hpp>
#include <vector>

namespace muster {

template <class Walls>
std::vector<scene::Wall> scene_walls(const Walls& walls) {
  std::vector<scene::Wall> result;
  for (const Wall& w : walls)
    result.push_back({w.x0, w.y0, w.x1, w.y1, w.base, w.height, w.thickness, static_cast<int>(w.material)});
  return result;
}

template <class Doors, class States, class Walls>
std::vector<scene::Door> scene_doors(const Doors& doors, const States& states, const Walls& walls) {
  std::vector<scene::Door> result;
  for (std::size_t i = 0; i < doors.size(); ++i) {
    const Door& d = doors[i];
    const double material = is_null(d.material) ? walls[static_cast<std::size_t>(d.wall)].material : d.material;
    result.push_back(
        {static_cast<int>(d.wall), d.at, d.width, d.height, static_cast<int>(material), states[i].open != 0});
  }
  return result;
}

template <class Floors>
std::vector<scene::Floor> scene_floors(const Floors& floors) {
  std::vector<scene::Floor> result;
  for (const FloorShape& f : floors)
    result.push_back({{f.x0, f.x1, f.x2, f.x3}, {f.y0, f.y1, f.y2, f.y3}, f.z, static_cast<int>(f.material)});
  return result;
}

}  // namespace muster
