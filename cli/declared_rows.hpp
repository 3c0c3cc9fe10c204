// Rows of a world's tables, without a run.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "world_file/world.hpp"

namespace muster::cli {

// Rows of a table as the world file gives them; a run has them only where a plugin reads them.
template <class Row>
std::vector<Row> declared_rows(const World& world, const std::string& set, const std::string& quantity) {
  std::vector<Row> result;
  for (const RowDeclaration& row : world.rows) {
    if (row.set != set) continue;
    Row cells{};
    for (const StoredValues& given : row.values) {
      if (given.table != set + '/' + quantity) continue;
      auto* first = reinterpret_cast<double*>(&cells);
      given.store ? given.store(given.values.data(), first)
                  : static_cast<void>(std::copy(given.values.begin(), given.values.end(), first));
    }
    result.push_back(cells);
  }
  return result;
}

}  // namespace muster::cli
