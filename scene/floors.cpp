#include "scene/floors.hpp"

#include "scene/refusal.hpp"

namespace muster::scene {
namespace {

// True if they cross in a point that is no end of either.
bool cross(const Spot& a, const Spot& b, const Spot& c, const Spot& d) {
  const auto apart = [](std::int64_t one, std::int64_t other) {
    return (one < 0 && other > 0) || (one > 0 && other < 0);
  };
  return apart(orientation(a, b, c), orientation(a, b, d)) && apart(orientation(c, d, a), orientation(c, d, b));
}

void check_corners(const Spot (&at)[4], int row) {
  if (cross(at[0], at[1], at[2], at[3]) || cross(at[1], at[2], at[3], at[0]))
    refuse("floor", row, "two of its edges cross; expected its corners in turn");
  if (orientation(at[0], at[1], at[2]) + orientation(at[0], at[2], at[3]) == 0)
    refuse("floor", row, "has no area; expected four corners in turn");
}

}  // namespace

Floors::Floors(const std::vector<Floor>& floors, int materials) {
  for (const Floor& floor : floors) {
    const int row = static_cast<int>(floors_.size());
    Spot at[4];
    for (int i = 0; i < 4; ++i) {
      if (!within_extent(floor.x[i]) || !within_extent(floor.y[i]) || !within_extent(floor.z))
        refuse("floor", row, "reaches beyond the scene; expected coordinates within 1000 m");
      at[i] = {snap(floor.x[i]), snap(floor.y[i])};
    }
    check_corners(at, row);
    check_material("floor", row, floor.material, materials);
    const std::int64_t z = snap(floor.z);
    const auto corner = [&](int i) { return Vector{at[i].x, at[i].y, z}; };
    floors_.push_back({{{corner(0), corner(1), corner(2)}, {corner(0), corner(2), corner(3)}}, z, floor.material});
  }
}

}  // namespace muster::scene
