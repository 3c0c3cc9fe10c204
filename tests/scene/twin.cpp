#include "twin.hpp"

#include <cmath>
#include <optional>
#include <stdexcept>

namespace muster::scene {
namespace {

__extension__ using Wide = __int128;

// A metre in the twin's units. The shifts: up by far more than east, east by far more than north. All three are too
// small to carry a point over anything: two different heights or places on these lattices are at least 2^9 units apart,
// and a shift of the ends moves a crossing by less than 2^8 units along the wall and 2^11 units up.
constexpr Wide metre = Wide{1} << 32;
constexpr Wide shift_east = 16, shift_north = 1, shift_up = 1 << 12;

struct PlanVector {
  Wide x, y;
};

PlanVector spot(double x, double y) { return {static_cast<Wide>(x) * metre, static_cast<Wide>(y) * metre}; }
PlanVector operator-(const PlanVector& a, const PlanVector& b) { return {a.x - b.x, a.y - b.y}; }
Wide cross(const PlanVector& a, const PlanVector& b) { return a.x * b.y - a.y * b.x; }

// numerator / denominator, denominator > 0.
struct Ratio {
  Wide numerator, denominator;

  // After the shift there are no ties: one would be a mistake in the twin.
  bool is_over(Wide number, Wide divisor = 1) const {
    const Wide left = numerator * divisor, right = number * denominator;
    if (left == right) throw std::logic_error("the twin met a tie");
    return left > right;
  }
};

struct Meeting {
  Ratio along_link, along_wall;
};

// Where the two lines meet in plan; nothing if they are parallel.
std::optional<Meeting> meeting(const PlanVector& p, const PlanVector& q, const PlanVector& a, const PlanVector& b) {
  const PlanVector link = q - p, wall = b - a;
  const Wide denominator = cross(link, wall);
  if (denominator == 0) return {};
  const Wide sign = denominator > 0 ? 1 : -1;
  return Meeting{{sign * cross(a - p, wall), sign * denominator}, {sign * cross(a - p, link), sign * denominator}};
}

bool is_inside(const Ratio& part) { return part.is_over(0) && !part.is_over(1); }

std::int64_t steps(double metres) { return std::llround(metres * 4096); }

bool is_over_height(const Ratio& along_link, double pz, double qz, double height) {
  const Wide start = static_cast<Wide>(pz) * metre + shift_up;
  const Wide rise = static_cast<Wide>(qz - pz);  // metres: the division below is by metre as well
  const Wide height_in_units = static_cast<Wide>(height * 4096) * (metre / 4096);
  const Ratio at_crossing{start * along_link.denominator + rise * metre * along_link.numerator, along_link.denominator};
  return at_crossing.is_over(height_in_units);
}

}  // namespace

std::vector<std::pair<int, int>> Twin::crossings(const Point& p, const Point& q) const {
  std::vector<std::pair<int, int>> result;
  const PlanVector shift{shift_east, shift_north};
  const PlanVector from = spot(p.x, p.y) - PlanVector{-shift.x, -shift.y},
                   to = spot(q.x, q.y) - PlanVector{-shift.x, -shift.y};
  for (std::size_t row = 0; row < walls_.size(); ++row) {
    const Wall& wall = walls_[row];
    const auto meet = meeting(from, to, spot(wall.x0, wall.y0), spot(wall.x1, wall.y1));
    if (!meet || !is_inside(meet->along_link) || !is_inside(meet->along_wall)) continue;
    if (!is_over_height(meet->along_link, p.z, q.z, wall.base)) continue;
    if (is_over_height(meet->along_link, p.z, q.z, wall.base + wall.height)) continue;
    int crossed_door = -1;
    bool open = false;
    const std::int64_t length = steps(std::hypot(wall.x1 - wall.x0, wall.y1 - wall.y0));
    for (std::size_t number = 0; number < doors_.size(); ++number) {
      const Door& door = doors_[number];
      if (door.wall != static_cast<int>(row)) continue;
      if (!meet->along_wall.is_over(steps(door.at), length)) continue;
      if (meet->along_wall.is_over(steps(door.at + door.width), length)) continue;
      if (is_over_height(meet->along_link, p.z, q.z, wall.base + door.height)) continue;
      crossed_door = static_cast<int>(number);
      open = door.open;
    }
    if (!open) result.emplace_back(static_cast<int>(row), crossed_door);
  }
  return result;
}

}  // namespace muster::scene
