// The cells of a row's table as the world file gives them.
#pragma once

#include <algorithm>
#include <vector>

#include "world.hpp"

namespace muster {

inline std::vector<double> stored_cells(const RowDeclaration& row, std::string_view table, std::size_t width) {
  std::vector<double> cells(width, 0);
  for (const auto& values : row.values) {
    if (values.table != table) continue;
    if (values.store)
      values.store(values.values.data(), cells.data());
    else
      std::copy_n(values.values.begin(), std::min(values.values.size(), width), cells.begin());
  }
  return cells;
}

}  // namespace muster
