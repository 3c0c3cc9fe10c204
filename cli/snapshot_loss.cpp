#include "snapshot_loss.hpp"

#include <algorithm>
#include <chrono>

#include "divergence.hpp"
#include "text/number.hpp"
#include "verbs.hpp"

namespace muster::cli {
namespace {

constexpr uint64_t least_ticks = 200;  // of a short run, too: they take no time

// What acts on others by more than its tables would act twice.
bool acts_outside(const Simulation& run) {
  const auto acts = [](const auto& instance) {
    const std::string id = instance->plugin().id;
    return id.starts_with("bridge.") || id.starts_with("host.") || id.starts_with("device.");
  };
  return std::any_of(run.instances().begin(), run.instances().end(), acts);
}

std::string words(const Simulation& run, const FirstDifference& first) {
  return "at " + print_real(run.time()) + " s, in " + first.table + ", row " + first.row +
         (first.column.empty() ? "" : ", " + first.column) + ", which " + first.writer[0] +
         " writes: " + first.value[1] + " instead of " + first.value[0];
}

}  // namespace

std::string loss_of_snapshot(Simulation& run, const World& world, Options options, double seconds) {
  if (acts_outside(run)) return "";
  const auto began = std::chrono::steady_clock::now();
  const auto is_late = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count() > seconds;
  };
  const std::string begin = "does not hold all of the run's state: restored in a world of its own it ";
  const std::string expected =
      "; such a plugin keeps state in members or static variables, which no snapshot holds; expected it in a table, "
      "s.write<State>(\"self/state\") and k.last(state)";
  Simulation restored(world, standard(), std::move(options));
  restored.restore(run.snapshot());
  Divergence divergence({}, 1);
  const uint64_t last = run.tick() + std::max(run.tick(), least_ticks);
  while (run.tick() < last && !is_late() && !interrupted()) {
    try {
      run.step();
    } catch (const Error&) {
      return "";  // beyond its end a run may fail
    }
    try {
      restored.step();
    } catch (const Error& e) {
      return begin + "fails at " + print_real(run.time()) + " s: " + e.what() + expected;
    }
    divergence.look(run, restored);
    if (divergence.first()) return begin + "goes on otherwise " + words(run, *divergence.first()) + expected;
  }
  return "";
}

}  // namespace muster::cli
