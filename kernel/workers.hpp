// The threads of a run.
#pragma once

#include "simulation.hpp"

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

namespace muster {

struct Simulation::Workers {
  explicit Workers(int threads) : arena(threads) {}

  template <class Body> void each(std::size_t count, const Body& body) {
    arena.execute([&] { tbb::parallel_for(std::size_t{0}, count, body, tbb::simple_partitioner{}); });
  }

  tbb::task_arena arena;
};

}  // namespace muster
