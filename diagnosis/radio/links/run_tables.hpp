// Reads tables of a run's blackboard as typed rows.
#pragma once

#include <string>
#include <vector>

#include "kernel/simulation.hpp"

namespace muster {

// Rows of a published table; empty if the world has none.
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
