// The threads of a run.
#pragma once

#include "simulation.hpp"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

namespace muster {

struct Simulation::Workers {
  explicit Workers(int threads)
      : limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)), arena(threads) {}

  template <class Body> void each(std::size_t count, const Body& body) {
    arena.execute([&] { tbb::parallel_for(std::size_t{0}, count, body, tbb::simple_partitioner{}); });
  }

  tbb::global_control limit;  // as many threads as were asked for, even where the machine has fewer processors
  tbb::task_arena arena;
};

}  // namespace muster
