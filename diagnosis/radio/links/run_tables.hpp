// What stands on a run's blackboard, as rows of the standard tables.
#pragma once

#include <string>
#include <vector>

#include "kernel/simulation.hpp"

namespace muster {

// A published table's rows; none where the world has no such table.
template <class Row>
std::vector<Row> rows_of(const Simulation& run, const std::string& name) {
  const Table* table = run.board().find(name);
  if (!table) return {};
  const auto* first = reinterpret_cast<const Row*>(table->now().data.data());
  return {first, first + table->now().rows};
}

inline std::vector<std::string> names_of(const Simulation& run, const std::string& set) {
  const Set* found = run.board().find_set(set);
  return found ? found->names : std::vector<std::string>{};
}

}  // namespace muster
