#include "walls.hpp"

#include <algorithm>

namespace muster::ode {

namespace {

constexpr double thinnest = 0.02;  // [m]: through less, a robot may step without having touched it

}  // namespace

std::vector<WallBox> wall_boxes(Rows<const Wall> walls, Rows<const Door> doors, Rows<const DoorState> states) {
  std::vector<WallBox> boxes;
  for (std::size_t w = 0; w < walls.size(); ++w) {
    const Wall& wall = walls[w];
    const double dx = wall.x1 - wall.x0, dy = wall.y1 - wall.y0, length = std::hypot(dx, dy);
    std::vector<Door> open;
    std::vector<double> cuts = {0, length};
    for (std::size_t d = 0; d < doors.size(); ++d) {
      if (doors[d].wall != static_cast<double>(w) || states[d].open == 0) continue;
      open.push_back(doors[d]);
      for (const double at : {doors[d].at, doors[d].at + doors[d].width}) cuts.push_back(std::clamp(at, 0.0, length));
    }
    std::sort(cuts.begin(), cuts.end());
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
      const double middle = (cuts[i] + cuts[i + 1]) / 2;
      double gap = 0;  // under it a robot passes
      for (const Door& door : open) {
        if (door.at <= middle && middle <= door.at + door.width) gap = std::max(gap, door.height);
      }
      if (cuts[i + 1] <= cuts[i] || gap >= wall.height) continue;
      boxes.push_back(
          {{wall.x0 + middle * dx / length, wall.y0 + middle * dy / length, wall.base + (gap + wall.height) / 2},
           {cuts[i + 1] - cuts[i], std::max(wall.thickness, thinnest), wall.height - gap},
           std::atan2(dy, dx)});
    }
  }
  return boxes;
}

}  // namespace muster::ode
