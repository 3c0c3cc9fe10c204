// The scans that a run has sent in its last tick.
#pragma once

#include <cstring>
#include <muster/sets.hpp>
#include <utility>
#include <vector>

#include "kernel/simulation.hpp"

namespace muster::test {

struct Seen {
  Scan scan;
  std::vector<double> ranges;
  double angle(std::size_t i) const { return scan.min_angle + static_cast<double>(i) * scan.step; }
};

inline std::vector<Seen> scans(const Simulation& run) {
  const TableView queue = run.table("scan/*/message");
  std::vector<Seen> result;
  for (std::size_t i = 0; i < queue.rows(); ++i) {
    Seen seen;
    std::memcpy(&seen.scan, queue.table->now().data.data() + i * queue.cols(), sizeof seen.scan);
    const auto& bytes = *queue.table->now().blobs[static_cast<std::size_t>(seen.scan.ranges) - 1];
    seen.ranges.resize(bytes.size() / sizeof(double));
    std::memcpy(seen.ranges.data(), bytes.data(), bytes.size());
    result.push_back(std::move(seen));
  }
  return result;
}

}  // namespace muster::test
