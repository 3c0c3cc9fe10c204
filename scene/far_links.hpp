// Links whose ends lie beyond the lattice: cut to the box that holds all walls. What a cut link crosses is exact; the
// cut itself is rounded to the lattice, so far radios move by less than 0.3 mm a kilometre from the walls' box.
#pragma once

#include <optional>

#include "scene/point.hpp"

namespace muster::scene {

// The part of a link within the extent, and its ends as shares of the way from p to q.
struct NearPart {
  Point from, to;
  double begin = 0, end = 1;
};

bool is_near(const Point& point);
// Nothing if the link passes outside. The same part, with its ends exchanged, from q to p. Throws std::runtime_error
// for a point beyond 100 km.
std::optional<NearPart> near_part(const Point& p, const Point& q);

}  // namespace muster::scene
