// Walls in the layout of the kernels: blocks of neighbours, under a bounding-box tree of 16 children a node.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/lattice.hpp"
#include "scene/wall_kernel.hpp"

namespace muster::scene {

class WallColumns {
 public:
  struct Source {
    Spot a, b;  // a -> b runs southward
    std::int64_t base = 0, top = 0;
    int material = 0;
    bool has_doors = false;
  };

  WallColumns() = default;
  WallColumns(const std::vector<Source>& walls, int materials);

  WallTable table() const;
  // Row of a wall in the scene, or -1 for padding of a block.
  int row(int wall) const { return row_[static_cast<std::size_t>(wall)]; }

 private:
  void add_boxes();

  std::vector<WallBlock> walls_;
  std::vector<int> row_;
  std::vector<std::vector<BoxBlock>> levels_;
  int materials_ = 0;
};

}  // namespace muster::scene
