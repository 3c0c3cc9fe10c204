#include "scene/slabs.hpp"

#include <algorithm>
#include <cmath>

namespace muster::scene {

namespace {

Slab part(const Wall& wall, int row, double from, double to, double base, double top) {
  const double x = wall.x1 - wall.x0, y = wall.y1 - wall.y0, length = std::hypot(x, y);
  Slab slab;
  slab.cos_yaw = x / length;
  slab.sin_yaw = y / length;
  slab.x = wall.x0 + 0.5 * (from + to) * slab.cos_yaw;
  slab.y = wall.y0 + 0.5 * (from + to) * slab.sin_yaw;
  slab.z = 0.5 * (base + top);
  slab.length = to - from;
  slab.thickness = wall.thickness;
  slab.height = top - base;
  slab.wall = row;
  return slab;
}

}  // namespace

std::vector<Slab> slabs(const std::vector<Wall>& walls, const std::vector<Door>& doors) {
  std::vector<Slab> result;
  for (std::size_t row = 0; row < walls.size(); ++row) {
    const Wall& wall = walls[row];
    const int number = static_cast<int>(row);
    const double length = std::hypot(wall.x1 - wall.x0, wall.y1 - wall.y0), top = wall.base + wall.height;
    if (!(length > 0)) continue;
    std::vector<const Door*> open;
    for (const Door& door : doors) {
      if (door.wall == number && door.open && door.at < length) open.push_back(&door);
    }
    std::sort(open.begin(), open.end(), [](const Door* a, const Door* b) { return a->at < b->at; });
    double done = 0;  // along the wall
    for (const Door* door : open) {
      const double from = std::max(door->at, done), to = std::min(door->at + door->width, length);
      if (from > done) result.push_back(part(wall, number, done, from, wall.base, top));
      if (to > from && door->height < wall.height)
        result.push_back(part(wall, number, from, to, wall.base + door->height, top));
      done = std::max(done, to);
    }
    if (length > done) result.push_back(part(wall, number, done, length, wall.base, top));
  }
  return result;
}

}  // namespace muster::scene
