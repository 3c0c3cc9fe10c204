// Ten RDK hexapods that walk for 10 s, against ODE. What is compared is how far they get: each engine against itself in
// steps of 0.05 ms, since contact laws differ (0.3 % in travel). Goal: 3 times ODE's speed at 0.2 %.
#pragma once

#include <benchmark/benchmark.h>

#include <limits>
#include <stdexcept>
#include <string>

#include "cpu_seconds.hpp"
#include "plugins/robots/tripod_gait.hpp"
#include "raw_ode_legs.hpp"

namespace muster::bench {

class Hexapods {
 public:
  static constexpr double until = 10, limit = 0.002;

  struct Outcome {
    double seconds = std::numeric_limits<double>::infinity();  // of CPU time, the best so far
    double travel = 0;                                         // [m]
    void again(const Outcome& o) { seconds = std::min(seconds, o.seconds), travel = o.travel; }
  };

  static Outcome ours(int count, int steps) {
    std::vector<simbody::NamedRobot> robots;
    std::vector<simbody::RobotState> states;
    for (int i = 0; i < count; ++i) {
      robots.push_back({"r" + std::to_string(i), &rdk()});
      states.push_back(simbody::at_rest(0, 2.0 * i, 0));
    }
    const auto engine = simbody::make_engine(robots, simbody::Integrator::midpoint, 1);
    const double h = until / steps, start = cpu_seconds();
    for (int k = 0; k < steps; ++k)
      engine->step(h, std::vector<simbody::Command>(robots.size(), asked(k * h, h)), states);
    return {cpu_seconds() - start, walked(states[0].pose[0], states[0].pose[2] + 0.12)};
  }

  static Outcome theirs(int count, int steps) {
    RawOdeLegs ode(rdk(), count);
    const double h = until / steps, start = cpu_seconds();
    for (int k = 0; k < steps; ++k) ode.step(asked(k * h, h), h);
    return {cpu_seconds() - start, walked(ode.x(0), ode.z(0))};
  }

  // The longest step that stays within the limit, as all shorter ones do.
  template <class Run>
  static int fewest_steps(double truth, Run run) {
    int best = 0;
    for (const int steps : {40000, 20000, 10000, 5000, 4000, 2500, 2000, 1600, 1250, 1000}) {
      if (std::abs(run(1, steps).travel / truth - 1) > limit) break;
      best = steps;
    }
    if (!best) throw std::logic_error("no step is short enough");
    return best;
  }

 private:
  static const description::Robot& rdk() {
    static const auto robot = description::read_robot(MUSTER_SOURCE_DIR "/plugins/robots/models/rdk.urdf");
    return robot;
  }

  // One stride a second; legs take their sweep when they are upright or straight up for the first time.
  static double angle(double t, int tripod) {
    const double phase = 0.25 + t + 0.5 * tripod;
    return clock_angle(phase, phase < (tripod ? 1.0 : 0.5) ? 0 : 1, 0.65);
  }
  static simbody::Command asked(double t, double h) {
    simbody::Command command{};
    double begin[2], rate[2];
    for (int tripod = 0; tripod < 2; ++tripod) {
      begin[tripod] = angle(t, tripod);
      rate[tripod] = std::remainder(angle(t + h, tripod) - begin[tripod], whole_turn) / h;
    }
    for (std::size_t i = 0; i < 6; ++i) {
      const int tripod = rdk().legs->legs[i].tripod;
      command.leg_angle[i] = begin[tripod], command.leg_rate[i] = rate[tripod];
    }
    return command;
  }

  static double walked(double travel, double height) {
    if (height < 0.1 || height > 0.13 || travel < 1.7 || travel > 1.9) throw std::logic_error("a hexapod fell");
    return travel;
  }
};

inline void hexapods_report(benchmark::State& state, int our_steps, int their_steps, double our_truth,
                            double their_truth) {
  constexpr int count = 10;
  Hexapods::Outcome we, they;
  for (auto _ : state) we.again(Hexapods::ours(count, our_steps)), they.again(Hexapods::theirs(count, their_steps));
  state.counters["ms_step_ours"] = 1e3 * Hexapods::until / our_steps;
  state.counters["ms_step_ode"] = 1e3 * Hexapods::until / their_steps;
  state.counters["us_ours"] = 1e6 * we.seconds / count / our_steps;
  state.counters["us_ode"] = 1e6 * they.seconds / count / their_steps;
  state.counters["percent_ours"] = 100 * (we.travel / our_truth - 1);
  state.counters["percent_ode"] = 100 * (they.travel / their_truth - 1);
  state.counters["travel_ours"] = our_truth;
  state.counters["travel_ode"] = their_truth;
  state.counters["speed"] = they.seconds / we.seconds;
  state.counters["real_time"] = Hexapods::until / we.seconds;
  state.counters["real_time_ode"] = Hexapods::until / they.seconds;
}

inline void hexapods_against_ode(benchmark::State& state) {
  constexpr int refined = 200000;
  static const double our_truth = Hexapods::ours(1, refined).travel, their_truth = Hexapods::theirs(1, refined).travel;
  if (state.range(0)) {  // at the same step
    const int steps = static_cast<int>(1e6 * Hexapods::until / static_cast<double>(state.range(0)));
    return hexapods_report(state, steps, steps, our_truth, their_truth);
  }
  const int we = Hexapods::fewest_steps(our_truth, Hexapods::ours);
  const int they = Hexapods::fewest_steps(their_truth, Hexapods::theirs);
  hexapods_report(state, we, they, our_truth, their_truth);
}
// Argument: both sides' step in microseconds; 0: for each the longest within the limit.
BENCHMARK(hexapods_against_ode)
    ->ArgName("us")
    ->Arg(0)
    ->Arg(1000)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(3)
    ->MeasureProcessCPUTime();

}  // namespace muster::bench
