// Overlaps of many axis-aligned boxes: sort and sweep (Baraff 1992). Some boxes are static, the others move.
#pragma once

#include <Eigen/Dense>
#include <utility>
#include <vector>

namespace muster::simbody {

struct Extent {
  Eigen::Vector3d low, high;  // [m]

  bool overlaps(const Extent& b) const {
    return (low.array() <= b.high.array() && b.low.array() <= high.array()).all();
  }
  bool holds(const Extent& b) const { return (low.array() <= b.low.array() && b.high.array() <= high.array()).all(); }
};

class BroadPhase {
 public:
  using Pairs = std::vector<std::pair<int, int>>;  // sorted

  void set_standing(std::vector<Extent> standing);

  // Pairs among the moving, the smaller index first, and pairs (moving, static): independent of the order in space.
  void find(const std::vector<Extent>& moving);
  const Pairs& among() const { return among_; }
  const Pairs& with_standing() const { return with_standing_; }

 private:
  std::vector<Extent> standing_;
  std::vector<int> standing_order_, order_;  // by their begins along x
  std::vector<int> open_, open_standing_;    // those that the sweep is still inside
  Pairs among_, with_standing_;
};

}  // namespace muster::simbody
