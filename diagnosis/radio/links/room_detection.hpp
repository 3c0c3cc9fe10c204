// Detects rooms of a plan: areas enclosed by walls, with doors, and gaps that may be some, taken as closed.
#pragma once

#include <array>
#include <vector>

namespace muster::diagnosis {

// A rectangle of the plan by its middle, in m and rad; its length runs along the angle.
struct OrientedRectangle {
  double x, y, length, angle, width;

  bool holds(double east, double north) const;
};

struct Room {
  OrientedRectangle bounds;
  int visits = 0;  // number of given places inside
};

// Rooms enclosed by walls (x0 y0 x1 y1, m) around any of `places`, by flood fill on a raster along `angle`. Areas open
// to the outside are no rooms. Most visits first.
std::vector<Room> rooms_of(const std::vector<std::array<double, 4>>& walls, double angle,
                           const std::vector<std::array<double, 2>>& places);

}  // namespace muster::diagnosis
