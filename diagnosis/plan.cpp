#include "diagnosis/plan.hpp"

#include <cmath>
#include <muster/floors.hpp>
#include <muster/tables.hpp>

#include "diagnosis/run_tables.hpp"

namespace muster {
namespace {

std::size_t at(double row) { return static_cast<std::size_t>(row); }

}  // namespace

scene::Scene scene_of(const Simulation& run) {
  std::vector<scene::Wall> walls;
  const auto given = rows_of<Wall>(run, "wall/*/shape");
  for (const Wall& w : given)
    walls.push_back({w.x0, w.y0, w.x1, w.y1, w.base, w.height, w.thickness, static_cast<int>(w.material)});
  std::vector<scene::Door> doors;
  const auto states = rows_of<DoorState>(run, "door/*/state");
  for (const Door& d : rows_of<Door>(run, "door/*/shape")) {
    const double material = std::isnan(d.material) ? given.at(at(d.wall)).material : d.material;
    const bool open = states.at(doors.size()).open != 0;
    doors.push_back({static_cast<int>(d.wall), d.at, d.width, d.height, static_cast<int>(material), open});
  }
  std::vector<scene::Floor> floors;
  for (const FloorShape& f : rows_of<FloorShape>(run, "floor/*/shape"))
    floors.push_back({{f.x0, f.x1, f.x2, f.x3}, {f.y0, f.y1, f.y2, f.y3}, f.z, static_cast<int>(f.material)});
  return {walls, doors, static_cast<int>(names_of(run, "material").size()), floors};
}

picture::FloorPlan plan_of(const Simulation& run) {
  picture::FloorPlan plan;
  const auto materials = names_of(run, "material");
  const auto walls = rows_of<Wall>(run, "wall/*/shape");
  for (const Wall& w : walls)
    plan.walls.push_back({{w.x0, w.y0}, {w.x1, w.y1}, w.thickness, materials.at(at(w.material))});
  const auto states = rows_of<DoorState>(run, "door/*/state");
  for (const Door& d : rows_of<Door>(run, "door/*/shape")) {
    const Wall& w = walls.at(at(d.wall));
    const double length = std::hypot(w.x1 - w.x0, w.y1 - w.y0);
    const auto along = [&](double s) {
      return picture::Point{w.x0 + s / length * (w.x1 - w.x0), w.y0 + s / length * (w.y1 - w.y0)};
    };
    const bool open = states.at(plan.doors.size()).open != 0;
    plan.doors.push_back({along(d.at), along(d.at + d.width), open, w.thickness});
  }
  const auto radios = names_of(run, "radio");
  const auto mounts = rows_of<Mount>(run, "radio/*/mount");
  for (std::size_t i = 0; i < mounts.size(); ++i)
    if (std::isnan(mounts[i].robot)) plan.stations.push_back({{mounts[i].x, mounts[i].y}, radios[i]});
  return plan;
}

}  // namespace muster
