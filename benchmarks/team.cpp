// What a team of three kinds costs that moves and talks (worlds/mixed_team): 20 Scarabs, 5 hexapods and 5 quadrotors,
// 30 radios on one channel. Goal (the project's): 20 times as fast as real time on two cores. Counters: real_time,
// simulated over CPU time of all threads; stepping, over that of the thread that steps, which works or spins but for
// naps: what a clock shows where every worker has a core to itself; wall, over what the clock did show; us_tick, CPU
// time of all threads.
#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <ctime>
#include <stdexcept>
#include <vector>

#include "kernel/simulation.hpp"

namespace {

using namespace muster;

constexpr double goal = 20;

double seconds_by(clockid_t clock) {
  timespec now;
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Of all threads, of the calling one, and on the wall.
constexpr std::array clocks = {CLOCK_PROCESS_CPUTIME_ID, CLOCK_THREAD_CPUTIME_ID, CLOCK_MONOTONIC};

void require(bool holds, const char* what) {
  if (!holds) throw std::logic_error(what);
}

struct Place {
  double x, y;
};

std::vector<Place> places(const Simulation& run) {
  const TableView pose = run.table("robot/*/pose");
  std::vector<Place> result;
  for (std::size_t i = 0; i < pose.rows(); ++i) result.push_back({pose.at(i, 0), pose.at(i, 1)});
  return result;
}

// Everybody went somewhere, and what became of each copy of a message is known, but for those in the air.
void check(const Simulation& run, const std::vector<Place>& before) {
  const std::vector<Place> now = places(run);
  for (std::size_t i = 0; i < now.size(); ++i)
    require(std::hypot(now[i].x - before[i].x, now[i].y - before[i].y) > 0.05, "a robot stands still");
  const TableView traffic = run.table("radio/*/traffic");
  double asked = 0, known = 0;
  for (std::size_t i = 0; i < traffic.rows(); ++i) {
    asked += traffic.at(i, 0);
    for (std::size_t c = 1; c < traffic.cols(); ++c) known += traffic.at(i, c);
  }
  require(asked > 0 && known <= asked && known > 0.99 * asked, "copies of messages are lost without a word");
}

// The same bits, however many workers there are.
void check_bits(const Simulation& run) {
  static const uint64_t first = run.digest();
  require(run.digest() == first, "the number of workers shows in the results");
}

void mixed_team(benchmark::State& state) {
  const auto workers = static_cast<int>(state.range(0));
  std::array<double, clocks.size()> seconds{};
  double simulated = 0, ticks = 0;
  for (auto _ : state) {
    const Standard& known = standard();
    Simulation run(read_world(MUSTER_SOURCE_DIR "/worlds/mixed_team", known), known,
                   {{MUSTER_PLUGINS_DIR}, workers, {}});
    run.step();
    const std::vector<Place> before = places(run);
    const double from = run.time();
    for (std::size_t i = 0; i < clocks.size(); ++i) seconds[i] -= seconds_by(clocks[i]);
    for (; !run.done(); ++ticks) run.step();
    for (std::size_t i = 0; i < clocks.size(); ++i) seconds[i] += seconds_by(clocks[i]);
    simulated += run.time() - from;
    check(run, before);
    check_bits(run);
  }
  state.counters["us_tick"] = 1e6 * seconds[0] / ticks;
  state.counters["real_time"] = simulated / seconds[0];
  state.counters["stepping"] = simulated / seconds[1];
  state.counters["wall"] = simulated / seconds[2];
  state.counters["of_goal"] = simulated / seconds[1] / goal;
}
BENCHMARK(mixed_team)
    ->ArgName("workers")
    ->Arg(1)
    ->Arg(2)
    ->Unit(benchmark::kSecond)
    ->Iterations(2)
    ->MeasureProcessCPUTime();

}  // namespace

BENCHMARK_MAIN();
