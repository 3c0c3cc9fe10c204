// The definition of a crossing, computed slowly: every radio is really moved, by a step so small that it decides only
// ties, and then the intersection is found in exact rational numbers. No predicate is shared with scene/.
#pragma once

#include <utility>
#include <vector>

#include "scene/walls.hpp"

namespace muster::scene {

// Whole metres from 0 to 7 everywhere, but for the doors' places, which may be any lattice steps.
class Twin {
 public:
  Twin(std::vector<Wall> walls, std::vector<Door> doors) : walls_(std::move(walls)), doors_(std::move(doors)) {}

  void set_open(int door, bool open) { doors_[door].open = open; }

  // Wall and door (or -1) of each crossing, by ascending wall.
  std::vector<std::pair<int, int>> crossings(const Point& p, const Point& q) const;

 private:
  std::vector<Wall> walls_;
  std::vector<Door> doors_;
};

}  // namespace muster::scene
