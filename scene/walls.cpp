#include "scene/walls.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <string>

#include "scene/crossing_link.hpp"
#include "scene/far_links.hpp"
#include "scene/refusal.hpp"

namespace muster::scene {
namespace {

// In any locale; six significant digits.
std::string text(double number) {
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof digits, number, std::chars_format::general, 6);
  return {digits, end.ptr};
}

void check_wall(const Wall& wall, int row, int materials) {
  for (const double metres : {wall.x0, wall.y0, wall.x1, wall.y1, wall.base, wall.base + wall.height}) {
    if (!within_extent(metres)) refuse("wall", row, "reaches beyond the scene; expected coordinates within 1000 m");
  }
  if (!(wall.thickness >= 0 && wall.thickness < extent)) {
    refuse("wall", row, "thickness is not a length; expected 0 m to 1000 m");
  }
  check_material("wall", row, wall.material, materials);
}

}  // namespace

void refuse_point(double x, double y, double z) {
  throw std::runtime_error("the point " + text(x) + ' ' + text(y) + ' ' + text(z) +
                           " lies beyond the scene; expected coordinates within 100 km");
}

LatticePoint snapped(const Point& point) {
  if (!is_near(point)) refuse_point(point.x, point.y, point.z);
  return {{snap(point.x), snap(point.y)}, snap(point.z)};
}

namespace {

Box box_around(const Spot& a, const Spot& b) {
  return {{std::min(a.x, b.x), std::min(a.y, b.y)}, {std::max(a.x, b.x), std::max(a.y, b.y)}};
}

// The sum is below 2^49, hence exact, and the root is the nearest double: the same on every machine.
double length_of(const Spot& a, const Spot& b, std::int64_t rise = 0) {
  const std::int64_t x = b.x - a.x, y = b.y - a.y;
  return std::sqrt(static_cast<double>(x * x + y * y + rise * rise));
}

}  // namespace

Scene::Scene(const std::vector<Wall>& walls, const std::vector<Door>& doors, int materials,
             const std::vector<Floor>& floors)
    : floors_(floors, materials), materials_(materials) {
  for (const Wall& wall : walls) add_wall(wall);
  std::vector<Box> boxes;
  for (const LatticeWall& wall : walls_) boxes.push_back(box_around(wall.a, wall.b));
  tree_ = BoxTree(boxes);
  for (const Door& door : doors) add_door(door);
  std::vector<WallColumns::Source> columns;
  for (const LatticeWall& wall : walls_) {
    columns.push_back({wall.a, wall.b, wall.base, wall.top, wall.material, !wall.doors.empty()});
  }
  columns_ = WallColumns(columns, materials_);
}

void Scene::add_wall(const Wall& wall) {
  const int row = static_cast<int>(walls_.size());
  check_wall(wall, row, materials_);
  LatticeWall snapped;
  snapped.a = {snap(wall.x0), snap(wall.y0)};
  snapped.b = {snap(wall.x1), snap(wall.y1)};
  snapped.base = snap(wall.base);
  snapped.top = snap(wall.base + wall.height);
  snapped.length = std::llround(length_of(snapped.a, snapped.b));
  snapped.material = wall.material;
  if (snapped.length == 0) refuse("wall", row, "has no length; expected ends at least 2^-12 m apart");
  if (snapped.top <= snapped.base) refuse("wall", row, "has no height; expected at least 2^-12 m");
  snapped.turned = !runs_southward(snapped.a, snapped.b);
  if (snapped.turned) std::swap(snapped.a, snapped.b);
  walls_.push_back(std::move(snapped));
}

void Scene::add_door(const Door& door) {
  const int row = static_cast<int>(doors_.size());
  if (door.wall < 0 || door.wall >= static_cast<int>(walls_.size())) {
    refuse("door", row, "wall row " + std::to_string(door.wall) + " does not exist");
  }
  check_material("door", row, door.material, materials_);
  LatticeWall& wall = walls_[door.wall];
  if (!within_extent(door.height)) refuse("door", row, "height is not below 1000 m");
  // No wall is longer than the diagonal of the scene.
  const auto may_be_along_wall = [](double metres) { return metres >= 0 && metres < 3 * extent; };
  if (!may_be_along_wall(door.at) || !may_be_along_wall(door.at + door.width)) {
    refuse("door", row, "begins or ends beyond its wall, wall row " + std::to_string(door.wall));
  }
  const std::int64_t from = snap(door.at), to = snap(door.at + door.width), height = snap(door.height);
  if (to <= from || height <= 0) refuse("door", row, "has no width or no height; expected at least 2^-12 m");
  if (to > wall.length + 2) {  // snapping both ends may shorten a wall by two steps
    refuse("door", row,
           "ends " + text(door.at + door.width) + " m along its wall, which is " +
               text(static_cast<double>(wall.length) / steps_per_metre) + " m long");
  }
  LatticeDoor snapped;
  snapped.from = wall.turned ? wall.length - to : from;
  snapped.to = wall.turned ? wall.length - from : to;
  snapped.top = wall.base + height;
  snapped.material = door.material;
  snapped.open = door.open;
  for (const int other : wall.doors) {
    if (snapped.from < doors_[other].to && doors_[other].from < snapped.to) {
      refuse("door", row, "overlaps door row " + std::to_string(other));
    }
  }
  wall.doors.push_back(row);
  doors_.push_back(snapped);
}

bool Scene::cross(const Link& link, int row, Hit& hit) const {
  const LatticeWall& wall = walls_[row];
  const std::int64_t a = orientation(link.span.from, link.span.to, wall.a);
  const std::int64_t b = orientation(link.span.from, link.span.to, wall.b);
  if (is_right(a) == is_right(b)) return false;
  hit = {row, -1, wall.material, orientation(wall.a, wall.b, link.span.from),
         orientation(wall.a, wall.b, link.span.to)};
  if (is_right(hit.from) == is_right(hit.to)) return false;
  if (hit.height_above(link, wall.base) < 0 || hit.height_above(link, wall.top) >= 0) return false;

  // An orientation is linear along the wall: that of a door's post, times the wall's length, is an integer too.
  const auto post_is_right = [&](std::int64_t at) { return Wide{a} * (wall.length - at) + Wide{b} * at < 0; };
  for (const int number : wall.doors) {
    const LatticeDoor& door = doors_[number];
    if (post_is_right(door.from) == post_is_right(door.to)) continue;
    if (hit.height_above(link, door.top) >= 0) return true;  // over the door: the wall is there
    hit.door = number;
    hit.material = door.material;
    return !door.open;
  }
  return true;
}

template <class Report>
void Scene::for_each_crossing(const Link& link, const Report& report) const {
  tree_.visit(link.span, [&](std::size_t wall) {
    Hit hit;
    if (cross(link, static_cast<int>(wall), hit)) report(hit);
  });
}

void Scene::crossings(const Point& p, const Point& q, std::vector<Crossing>& out) const {
  out.clear();
  if (!is_near(p) || !is_near(q)) {
    const auto part = near_part(p, q);
    if (!part) return;
    crossings(part->from, part->to, out);
    for (Crossing& crossing : out) crossing.fraction = part->begin + crossing.fraction * (part->end - part->begin);
    return;
  }
  const Link link(snapped(p), snapped(q));
  const double length = length_of(link.span.from, link.span.to, link.to_z - link.from_z);
  for_each_crossing(link, [&](const Hit& hit) {
    const LatticeWall& wall = walls_[hit.wall];
    const double change = static_cast<double>(hit.to - hit.from);
    Crossing crossing{hit.wall, hit.door, hit.material};
    crossing.fraction = static_cast<double>(link.turned ? hit.to : -hit.from) / change;
    crossing.z = static_cast<double>(hit.height_above(link, 0)) / std::abs(change) / steps_per_metre;
    crossing.cos_incidence = std::min(1.0, std::abs(change) / (length_of(wall.a, wall.b) * length));
    out.push_back(crossing);
  });
  std::sort(out.begin(), out.end(), [](const Crossing& a, const Crossing& b) { return a.wall < b.wall; });
  const Vector from = vector(snapped(p)), to = vector(snapped(q));
  floors_.for_each_crossing(from, to, [&](int row, const LatticeFloor& floor) {
    Crossing crossing{-1, -1, floor.material};
    crossing.fraction = static_cast<double>(floor.z - from.z) / static_cast<double>(to.z - from.z);
    crossing.z = static_cast<double>(floor.z) / steps_per_metre;
    crossing.cos_incidence = std::min(1.0, static_cast<double>(std::abs(to.z - from.z)) / length);
    crossing.floor = row;
    out.push_back(crossing);
  });
}

void Scene::counts(const Point& p, const Point& q, int* by_material) const {
  std::fill_n(by_material, materials_, 0);
  const auto part = near_part(p, q);
  if (!part) return;
  const LatticePoint from = snapped(part->from), to = snapped(part->to);
  for_each_crossing(Link(from, to), [&](const Hit& hit) { ++by_material[hit.material]; });
  floors_.for_each_crossing(vector(from), vector(to),
                            [&](int, const LatticeFloor& floor) { ++by_material[floor.material]; });
}

}  // namespace muster::scene
