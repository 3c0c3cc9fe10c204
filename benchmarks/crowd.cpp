// Fifty Scarabs that push each other, against ODE's quick solver as a program without a kernel has it: both sides in
// one run on the same commands, in steps of 10 ms, by the CPU time of this process, with the same eye on both. Goals
// (the project's): 2 times as fast in a crowd, as fast in a jam of one island; robots sink into each other, walls and
// ground by at most 1 mm, and no mass centre rises faster than 0.3 m/s. Counters: us_* of a robot-step, mm_* the
// deepest that anything sank, rise_* [m/s], speed (above 1: ours is better).
#include <benchmark/benchmark.h>

#include <stdexcept>

#include "cpu_seconds.hpp"
#include "crowds.hpp"  // Simbody first: it does not bear ODE's macros
#include "raw_ode.hpp"

namespace {

using namespace muster;
using bench::cpu_seconds;
using simbody::Command;
using simbody::RobotState;

constexpr double dt = 0.01, friction = 0.3;
constexpr int iterations_of_quick = 50;

struct Side {
  double seconds = 0;
  double deepest = 0, rise = 0;  // the worst of all runs [m], [m/s]

  void add(const simbody::Trouble& seen) {
    deepest = std::max(deepest, seen.deepest);
    rise = std::max(rise, seen.rise);
  }
};

// Both sides on the same commands from the same places.
class Match {
 public:
  template <class CommandOf>
  void play(const std::vector<RobotState>& start, const std::vector<scene::Wall>& walls, double until,
            CommandOf command_of) {
    const auto slabs = scene::slabs(walls, {});
    ours(start, slabs, until, command_of);
    theirs(start, slabs, until, command_of);
    steps_ += static_cast<double>(start.size()) * until / dt;
  }

  void report(benchmark::State& state) const {
    if (ours_.deepest > 1e-3 || ours_.rise > 0.3) {
      throw std::logic_error("ours sink by " + std::to_string(1e3 * ours_.deepest) + " mm and rise at " +
                             std::to_string(ours_.rise) + " m/s");
    }
    state.counters["us_ours"] = 1e6 * ours_.seconds / steps_;
    state.counters["us_ode"] = 1e6 * theirs_.seconds / steps_;
    state.counters["mm_ours"] = 1e3 * ours_.deepest;
    state.counters["mm_ode"] = 1e3 * theirs_.deepest;
    state.counters["rise_ours"] = ours_.rise;
    state.counters["rise_ode"] = theirs_.rise;
    state.counters["speed"] = theirs_.seconds / ours_.seconds;
  }

 private:
  template <class CommandOf>
  void ours(std::vector<RobotState> states, const std::vector<scene::Slab>& walls, double until, CommandOf command_of) {
    std::vector<simbody::NamedRobot> robots;
    for (std::size_t i = 0; i < states.size(); ++i) robots.push_back({"r" + std::to_string(i), &simbody::scarab()});
    const auto engine = simbody::make_engine(robots, simbody::Integrator::midpoint, dt);
    engine->set_surroundings(walls, friction);
    std::vector<Command> commands(states.size());
    simbody::Trouble seen;
    for (int k = 0; k < std::lround(until / dt); ++k) {
      for (std::size_t i = 0; i < states.size(); ++i) commands[i] = command_of(static_cast<int>(i), k * dt);
      const double start = cpu_seconds();
      engine->step(dt, commands, states);
      ours_.seconds += cpu_seconds() - start;
      seen.see(states, walls, dt);
    }
    ours_.add(seen);
  }

  template <class CommandOf>
  void theirs(std::vector<RobotState> states, const std::vector<scene::Slab>& walls, double until,
              CommandOf command_of) {
    std::vector<bench::RawOde::Start> starts;
    for (const RobotState& s : states) starts.push_back({s.pose[0], s.pose[1], simbody::yaw(s)});
    bench::RawOde ode(simbody::scarab(), starts, walls, iterations_of_quick);
    std::vector<std::array<double, 2>> rates(states.size());
    simbody::Trouble seen;
    for (int k = 0; k < std::lround(until / dt); ++k) {
      for (std::size_t i = 0; i < states.size(); ++i) {
        const Command c = command_of(static_cast<int>(i), k * dt);
        rates[i] = {c.left + 0.5 * dt * c.left_rate, c.right + 0.5 * dt * c.right_rate};
      }
      const double start = cpu_seconds();
      ode.step(dt, [&](std::size_t i) { return rates[i]; });
      theirs_.seconds += cpu_seconds() - start;
      for (std::size_t i = 0; i < states.size(); ++i) states[i].pose = ode.pose(i);
      seen.see(states, walls, dt);
    }
    theirs_.add(seen);
  }

  Side ours_, theirs_;
  double steps_ = 0;
};

// Argument: seeds. Ten seconds of random arcs in an arena (worlds/crowd).
void crowd(benchmark::State& state) {
  Match match;
  for (auto _ : state) {
    for (uint64_t seed = 1; seed <= static_cast<uint64_t>(state.range(0)); ++seed) {
      const simbody::RandomArcs arcs(seed);
      match.play(simbody::crowd_at_rest(seed), simbody::arena(simbody::crowd), 10,
                 [&](int i, double t) { return arcs.between(i, t, t + dt); });
    }
  }
  match.report(state);
}

// Argument: seeds. Five seconds of all pushing to the middle.
void jam(benchmark::State& state) {
  Match match;
  for (auto _ : state) {
    for (uint64_t seed = 1; seed <= static_cast<uint64_t>(state.range(0)); ++seed) {
      const Stream stream(seed);
      match.play(simbody::jam_at_rest(), {}, 5, [&](int i, double t) { return simbody::inward(stream, i, t); });
    }
  }
  match.report(state);
}

BENCHMARK(crowd)->ArgName("seeds")->Arg(20)->Unit(benchmark::kSecond)->Iterations(1)->MeasureProcessCPUTime();
BENCHMARK(jam)->ArgName("seeds")->Arg(10)->Unit(benchmark::kSecond)->Iterations(1)->MeasureProcessCPUTime();

}  // namespace

BENCHMARK_MAIN();
