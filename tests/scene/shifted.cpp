#include "shifted.hpp"

#include <cmath>

namespace muster::scene {
namespace {

__extension__ using Wide = __int128;

std::int64_t steps(double metres) { return std::llround(metres * 4096); }

// value + east e + north e^2
template <class Number>
bool is_positive(Number value, Number east, Number north) {
  return value != 0 ? value > 0 : east != 0 ? east > 0 : north > 0;
}

}  // namespace

ShiftedRadios::ShiftedRadios(const std::vector<Wall>& walls, const std::vector<Door>& doors) {
  for (const Wall& w : walls) {
    Line line{steps(w.x0), steps(w.y0), steps(w.x1), steps(w.y1), steps(w.base), steps(w.base + w.height),
              0,           w.material,  {}};
    const std::int64_t x = line.bx - line.ax, y = line.by - line.ay;
    line.length = std::llround(std::sqrt(static_cast<double>(x * x + y * y)));
    walls_.push_back(line);
  }
  for (const Door& d : doors) {
    Line& wall = walls_[d.wall];
    wall.doors.push_back({steps(d.at), steps(d.at + d.width), wall.base + steps(d.height), d.material, d.open});
  }
}

void ShiftedRadios::add_counts(const Point& from, const Point& to, int* by_material) const {
  const std::int64_t px = steps(from.x), py = steps(from.y), pz = steps(from.z);
  const std::int64_t qx = steps(to.x), qy = steps(to.y), qz = steps(to.z), dx = qx - px, dy = qy - py;
  for (const Line& wall : walls_) {
    // Twice the areas of the triangles that each end of the link forms with the wall, and each end of the wall with the
    // link; and how a shift changes them.
    const std::int64_t wx = wall.bx - wall.ax, wy = wall.by - wall.ay;
    const std::int64_t of_p = wx * (py - wall.ay) - wy * (px - wall.ax),
                       of_q = wx * (qy - wall.ay) - wy * (qx - wall.ax);
    if (is_positive(of_p, -wy, wx) == is_positive(of_q, -wy, wx)) continue;
    const std::int64_t of_a = dx * (wall.ay - py) - dy * (wall.ax - px),
                       of_b = dx * (wall.by - py) - dy * (wall.bx - px);
    if (is_positive(of_a, dy, -dx) == is_positive(of_b, dy, -dx)) continue;
    // True if the share of_p / (of_p - of_q) of the line from p to q is behind their intersection.
    const auto passes_over = [&](std::int64_t height) {
      const Wide above = Wide{pz - height} * (of_p - of_q) + Wide{qz - pz} * of_p;
      return of_p > of_q ? above >= 0 : above <= 0;
    };
    if (!passes_over(wall.base) || passes_over(wall.top)) continue;
    const auto post_is_left = [&](std::int64_t at) {
      const Wide of_post = Wide{of_a} * (wall.length - at) + Wide{of_b} * at;
      return is_positive(of_post, Wide{dy} * wall.length, -Wide{dx} * wall.length);
    };
    const Opening* through = nullptr;
    for (const Opening& door : wall.doors) {
      if (post_is_left(door.from) != post_is_left(door.to) && !passes_over(door.top)) through = &door;
    }
    if (through == nullptr) ++by_material[wall.material];
    if (through != nullptr && !through->open) ++by_material[through->material];
  }
}

}  // namespace muster::scene
