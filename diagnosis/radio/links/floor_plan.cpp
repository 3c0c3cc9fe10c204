#include "diagnosis/radio/links/floor_plan.hpp"

#include <cmath>
#include <muster/tables.hpp>

#include "diagnosis/radio/links/run_tables.hpp"
#include "plugins/scene_rows.hpp"

namespace muster {
namespace {

std::size_t at(double row) { return static_cast<std::size_t>(row); }

}  // namespace

scene::Scene scene_of(const Simulation& run) {
  const auto walls = rows_of<Wall>(run, "wall/*/shape");
  const auto doors = scene_doors(rows_of<Door>(run, "door/*/shape"), rows_of<DoorState>(run, "door/*/state"), walls);
  return {scene_walls(walls), doors, static_cast<int>(names_of(run, "material").size()),
          scene_floors(rows_of<FloorShape>(run, "floor/*/shape"))};
}

plotting::FloorPlan plan_of(const Simulation& run) {
  plotting::FloorPlan plan;
  const auto materials = names_of(run, "material");
  const auto walls = rows_of<Wall>(run, "wall/*/shape");
  for (const Wall& w : walls)
    plan.walls.push_back({{w.x0, w.y0}, {w.x1, w.y1}, w.thickness, materials.at(at(w.material))});
  // Where no plugin reads walls, their doors are not drawn either; where none reads how doors stand, they are shut.
  const auto states = rows_of<DoorState>(run, "door/*/state");
  const auto doors = rows_of<Door>(run, "door/*/shape");
  for (std::size_t i = 0; i < doors.size(); ++i) {
    const Door& d = doors[i];
    if (at(d.wall) >= walls.size()) continue;
    const Wall& w = walls[at(d.wall)];
    const double length = std::hypot(w.x1 - w.x0, w.y1 - w.y0);
    const auto along = [&](double s) {
      return plotting::Point{w.x0 + s / length * (w.x1 - w.x0), w.y0 + s / length * (w.y1 - w.y0)};
    };
    const bool open = i < states.size() && states[i].open != 0;
    plan.doors.push_back({along(d.at), along(d.at + d.width), open, w.thickness});
  }
  const auto radios = names_of(run, "radio");
  const auto mounts = rows_of<Mount>(run, "radio/*/mount");
  for (std::size_t i = 0; i < mounts.size(); ++i)
    if (std::isnan(mounts[i].robot)) plan.stations.push_back({{mounts[i].x, mounts[i].y}, radios[i]});
  return plan;
}

}  // namespace muster
