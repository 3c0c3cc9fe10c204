// What the kernel costs around a plugin. Peer of a step: a call through a pointer, which is what a program without a
// kernel would do. Goals: a no-op instance's step and publish in 30 ns, 50 plugins loaded in 40 ms, a step in another
// process 2 us longer (the median; it needs two free processors).
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "kernel/simulation.hpp"

namespace {

using namespace muster;

constexpr int many = 50;

Simulation world_of(const std::string& elements, uint64_t ticks, Isolations isolated = {}) {
  const auto file =
      std::filesystem::temp_directory_path() / ("muster_benchmark_" + std::to_string(::getpid()) + ".xml");
  std::ofstream(file) << "<world name=\"w\" dt=\"1\" until=\"" << ticks << "\">" << elements << "</world>";
  World world = read_world(file, standard());
  std::filesystem::remove(file);
  Options options{{MUSTER_BENCH_PLUGINS}, 1, {}};
  options.isolated = std::move(isolated);
  return {std::move(world), standard(), std::move(options)};
}

void call_through_pointer(benchmark::State& state) {
  double cell = 0;
  int (*step)(double, double*) = [](double time, double* to) { return *to = time, 0; };
  double time = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(step);
    step(++time, &cell);
    benchmark::DoNotOptimize(cell);
  }
}
BENCHMARK(call_through_pointer);

// The counter ns_per_instance is what an instance adds to a tick.
void no_op_instances(benchmark::State& state) {
  const auto count = state.range(0);
  std::string elements;
  for (int64_t i = 0; i < count; ++i) elements += "<bench.no_op name=\"i" + std::to_string(i) + "\"/>";
  Simulation run = world_of(elements, 1'000'000'000);
  for (auto _ : state) run.step();
  for (int64_t i = 0; i < count; ++i) {
    if (run.table("instance/i" + std::to_string(i) + "/cell").at(0, 0) != run.time())
      throw std::logic_error("an instance did not step");
  }
  state.counters["s_per_instance"] = benchmark::Counter(static_cast<double>(state.iterations() * count),
                                                        benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK(no_op_instances)->Arg(1)->Arg(10)->Arg(100)->Arg(1000);

// By the clock, for two processes share the work. The counters are those of single ticks.
void one_instance_in_another_process(benchmark::State& state) {
  Simulation run =
      world_of("<bench.no_op name=\"i\"/>", 1'000'000'000, state.range(0) ? Isolations{{"i", {}}} : Isolations{});
  std::vector<double> took;
  for (auto _ : state) {
    const auto began = std::chrono::steady_clock::now();
    run.step();
    took.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count());
  }
  if (run.table("instance/i/cell").at(0, 0) != run.time()) throw std::logic_error("the instance did not step");
  std::sort(took.begin(), took.end());
  state.counters["p50_s"] = took[took.size() / 2];
  state.counters["p99_s"] = took[took.size() * 99 / 100];
}
BENCHMARK(one_instance_in_another_process)->Arg(0)->Arg(1)->UseRealTime();

void load_50_plugins(benchmark::State& state) {
  std::string elements;
  for (int i = 1; i <= many; ++i) elements += "<bench.many_" + std::to_string(i) + "/>";
  for (auto _ : state) {
    const Simulation run = world_of(elements, 1);
    if (run.instances().size() != many) throw std::logic_error("not all plugins were loaded");
  }
}
BENCHMARK(load_50_plugins)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();

}  // namespace

BENCHMARK_MAIN();
