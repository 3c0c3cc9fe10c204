// Worlds of robots with sensors, their queues as rows, and the laws that every sensor keeps.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <muster/senses.hpp>

#include "tests/plugins/robots/robot_world.hpp"

namespace muster::test {

// Rows of a queue that were published in the last tick, as told by their time.
template <class Row>
std::vector<Row> told_now(const Simulation& run, const std::string& table, double now) {
  const TableView queue = run.table(table);
  std::vector<Row> result;
  for (std::size_t i = 0; i < queue.rows(); ++i) {
    Row one;
    std::memcpy(&one, queue.table->now().data.data() + i * queue.cols(), sizeof one);
    if (one.t == now) result.push_back(one);
  }
  return result;
}

inline double time_of(const Simulation& run) { return static_cast<double>(run.tick()) * run.world().dt; }

inline void run_ticks(Simulation& run, int ticks) {
  for (int i = 0; i < ticks; ++i) run.step();
}

// A run is the same for any number of workers, with the instance made again on the way, and after a restore.
inline void expect_one_run(const std::function<World()>& world, const std::string& instance, int ticks = 60) {
  const auto start = [&](int workers) { return Simulation(world(), standard(), options(workers)); };
  Simulation plain = start(1);
  run_ticks(plain, ticks);
  const auto expected = plain.digest();
  for (const int workers : {2, 3}) {
    Simulation run = start(workers);
    run_ticks(run, ticks);
    EXPECT_EQ(run.digest(), expected) << workers << " workers";
  }
  Simulation made_again = start(1), first = start(1), restored = start(1);
  for (int i = 0; i < ticks; ++i) {
    if (i % 7 == 3) made_again.remake(instance);
    made_again.step();
  }
  EXPECT_EQ(made_again.digest(), expected) << "made again";
  run_ticks(first, ticks / 2);
  restored.restore(first.snapshot());
  run_ticks(restored, ticks - ticks / 2);
  EXPECT_EQ(restored.digest(), expected) << "restored";
}

inline World world_in(const Folder& folder, const std::string& inside,
                      const std::string& attributes = "dt=\"0.05\" until=\"60\" seed=\"1\"") {
  return read_world(folder.write("world.xml", "<world name=\"test\" " + attributes + ">" + inside + "</world>"),
                    standard());
}

// What a world that cannot be is refused with.
inline std::string refusal(const std::function<void()>& make) {
  try {
    make();
  } catch (const std::exception& refused) {
    return refused.what();
  }
  return "nothing refused it";
}

}  // namespace muster::test
