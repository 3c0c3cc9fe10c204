#include "exam/crossings.hpp"

#include <algorithm>

namespace muster::exam {
namespace {

double area(Vec2 a, Vec2 b, Vec2 c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

bool in_open_door(const Plan& plan, int wall, double along, double height) {
  return std::any_of(plan.doors.begin(), plan.doors.end(), [&](const Door& d) {
    return d.wall == wall && d.open && along >= d.at && along < d.at + d.width && height < d.height;
  });
}

double length(const Wall& w) { return std::hypot(w.b.x - w.a.x, w.b.y - w.a.y); }

}  // namespace

std::optional<Meeting> meeting(Vec2 p, Vec2 q, Vec2 a, Vec2 b) {
  const double ap = area(a, b, p), aq = area(a, b, q), pa = area(p, q, a), pb = area(p, q, b);
  if ((ap > 0) == (aq > 0) || (pa > 0) == (pb > 0)) return {};
  const double link = std::hypot(q.x - p.x, q.y - p.y), wall = std::hypot(b.x - a.x, b.y - a.y);
  return Meeting{ap / (ap - aq), pa / (pa - pb), std::min(1.0, std::abs(ap - aq) / (link * wall))};
}

std::vector<Crossing> crossings(const Plan& plan, Vec3 from, Vec3 to) {
  std::vector<Crossing> result;
  for (int i = 0; i < static_cast<int>(plan.walls.size()); ++i) {
    const Wall& w = plan.walls[static_cast<std::size_t>(i)];
    const auto m = meeting({from.x, from.y}, {to.x, to.y}, w.a, w.b);
    if (!m) continue;
    const double z = from.z + m->along_link * (to.z - from.z);
    if (z < 0 || z >= w.height || in_open_door(plan, i, m->along_wall * length(w), z)) continue;
    result.push_back({i, w.material, m->cosine});
  }
  return result;
}

bool runs_into_wall(const Plan& plan, Vec2 from, Vec2 to) {
  return !crossings(plan, {from.x, from.y, 0}, {to.x, to.y, 0}).empty();
}

double chord(Vec2 p, Vec2 q, Vec2 centre, double radius) {
  const double dx = q.x - p.x, dy = q.y - p.y, way = std::hypot(dx, dy);
  if (way < 1e-9) return 0;
  const double ux = dx / way, uy = dy / way, fx = centre.x - p.x, fy = centre.y - p.y;
  const double middle = fx * ux + fy * uy, aside = fx * uy - fy * ux, square = radius * radius - aside * aside;
  if (square <= 0) return 0;
  const double half = std::sqrt(square);
  return std::max(0.0, std::min(way, middle + half) - std::max(0.0, middle - half));
}

double length_within(const Plan& plan, const Room& room, Vec2 p, Vec2 q) {
  const Vec2 a = plan.to_own(p), b = plan.to_own(q);
  double from = 0, to = 1;  // part of the link within both of the room's strips
  const auto strip = [&](double start, double end, double low, double high) {
    const double way = end - start;
    if (std::abs(way) < 1e-9) {
      if (start < low || start > high) to = from;
      return;
    }
    const double one = (low - start) / way, other = (high - start) / way;
    from = std::max(from, std::min(one, other));
    to = std::min(to, std::max(one, other));
  };
  strip(a.x, b.x, room.low.x, room.high.x);
  strip(a.y, b.y, room.low.y, room.high.y);
  return std::max(0.0, to - from) * std::hypot(b.x - a.x, b.y - a.y);
}

}  // namespace muster::exam
