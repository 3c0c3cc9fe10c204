// The rooms of a plan: what its walls close in, doors taken as closed.
#pragma once

#include <array>
#include <vector>

namespace muster::diagnosis {

// A rectangle of the plan by its middle, in m and rad; its length runs along the angle.
struct Strip {
  double x, y, length, angle, width;
};

struct Room {
  Strip bounds;
  int visits = 0;  // of the places given
};

// What walls (x0 y0 x1 y1, m) close in about any of `places`, by a flood of the free cells of a raster that lies along
// `angle`; what is open to the outside is no room. Those with most visits first.
std::vector<Room> rooms_of(const std::vector<std::array<double, 4>>& walls, double angle,
                           const std::vector<std::array<double, 2>>& places);

}  // namespace muster::diagnosis
