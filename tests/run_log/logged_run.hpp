// Runs the world of these tests in the test's own process, with a log.
#pragma once

#include <functional>
#include <muster/sets.hpp>

#include "kernel/simulation.hpp"
#include "run_log/run_log.hpp"
#include "tests/mcap/collected.hpp"

namespace muster::test {

// Up to this tick; `after` is called after each, with the run.
inline void run_logged(const std::filesystem::path& file, uint64_t ticks,
                       const std::function<void(const Simulation&)>& after = {}) {
  World world = read_world(MUSTER_LOG_WORLD, standard());
  world.ticks = ticks;
  const auto records = world.records;
  Simulation run(std::move(world), standard(), {{MUSTER_PLUGINS_DIR}, 1, {}});
  run_log::RunLog log(run, records, file, "of the test");
  log.write(run);
  while (!run.done()) {
    run.step();
    log.write(run);
    if (after) after(run);
  }
  log.close(run);
  run.close();
}

}  // namespace muster::test
