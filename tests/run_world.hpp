// A world that a test runs, and rows of its tables as plugins see them.
#pragma once

#include <muster/sets.hpp>
#include <string>

#include "kernel/simulation.hpp"
#include "tests/folder.hpp"

namespace muster::test {

template <class Row>
Row row(const Simulation& run, const std::string& table, std::size_t at = 0) {
  const TableView view = run.table(table);
  const double* first =
      view.table->now().data.data() + (view.row >= 0 ? static_cast<std::size_t>(view.row) : at) * view.cols();
  return *reinterpret_cast<const Row*>(first);
}

#ifdef MUSTER_TOYS_DIR
inline Options options(int workers = 1) { return {{MUSTER_PLUGINS_DIR, MUSTER_TOYS_DIR}, workers, {}}; }
#endif

}  // namespace muster::test
