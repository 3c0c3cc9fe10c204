// Crossings of a link, wall by wall in whole numbers: every radio is e to the east, e squared to the north, and far
// more up, where e is not small but a symbol. Nothing is shared with scene/, and no place is special.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/walls.hpp"

namespace muster::scene {

class ShiftedRadios {
 public:
  // All coordinates within 1000 m; doors lie within their walls.
  ShiftedRadios(const std::vector<Wall>& walls, const std::vector<Door>& doors);

  // Adds to by_material, as Scene::counts fills it.
  void add_counts(const Point& p, const Point& q, int* by_material) const;

 private:
  struct Opening {
    std::int64_t from, to, top;  // along the wall; height
    int material;
    bool open;
  };
  struct Line {
    std::int64_t ax, ay, bx, by, base, top, length;
    int material;
    std::vector<Opening> doors;
  };
  std::vector<Line> walls_;
};

}  // namespace muster::scene
