// Level floors with four corners each, and an exact test of the floors that a straight link passes.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/triangle.hpp"

namespace muster::scene {

// A level quadrilateral, by its corners in turn, in metres. A corner given twice makes a triangle of it.
struct Floor {
  double x[4] = {}, y[4] = {};
  double z = 0;
  int material = 0;
};

// In lattice steps. A point in exactly one of the halves is on the floor: they overlap outside a reflex corner.
struct LatticeFloor {
  Triangle halves[2];
  std::int64_t z = 0;
  int material = 0;

  bool is_crossed(const Vector& p, const Vector& q) const {
    if ((p.z < z) == (q.z < z)) return false;  // a radio on a floor is above it
    return halves[0].is_crossed(p, q) != halves[1].is_crossed(p, q);
  }
};

class Floors {
 public:
  Floors() = default;
  // Materials are numbered from 0 to materials - 1. Throws std::runtime_error with the faulty row and the reason.
  Floors(const std::vector<Floor>& floors, int materials);

  bool empty() const { return floors_.empty(); }

  // Calls report(row, floor) for each floor between p and q; the same both ways.
  template <class Report>
  void for_each_crossing(const Vector& p, const Vector& q, const Report& report) const {
    for (std::size_t row = 0; row < floors_.size(); ++row) {
      if (floors_[row].is_crossed(p, q)) report(static_cast<int>(row), floors_[row]);
    }
  }

 private:
  std::vector<LatticeFloor> floors_;
};

}  // namespace muster::scene
