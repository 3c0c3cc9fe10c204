#include "run_costs.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace muster::cli {

RunCosts costs_of(const Simulation& run) {
  RunCosts result;
  const Set* links = run.board().find_set("link");
  if (links) result.links = links->rows();
  for (const auto& each : run.instances()) {
    const double seconds = 1e-9 * static_cast<double>(each->cost.nanoseconds);
    const bool has_links = each->phase() == MUSTER_RADIO && result.links > 0 && each->cost.steps > 0;
    result.instances.push_back(
        {each->name(), each->plugin().id, phase_name(each->phase()), seconds, each->cost.steps,
         has_links ? seconds / static_cast<double>(each->cost.steps) / static_cast<double>(result.links) : 0});
  }
  std::stable_sort(result.instances.begin(), result.instances.end(),
                   [](const InstanceCost& a, const InstanceCost& b) { return a.seconds > b.seconds; });
  return result;
}

Json json_of(const RunCosts& costs) {
  Json result{{"links", costs.links}, {"instances", Json::array()}};
  for (const InstanceCost& each : costs.instances) {
    Json row{{"instance", each.instance},
             {"plugin", each.plugin},
             {"phase", each.phase},
             {"cpu_seconds", each.seconds},
             {"steps", each.steps}};
    if (each.a_link > 0) row["seconds_a_link"] = each.a_link;
    result["instances"].push_back(std::move(row));
  }
  return result;
}

void print(const RunCosts& costs) {
  constexpr double least = 5e-3;  // of the whole
  double whole = 0, left = 0, radio = 0;
  for (const InstanceCost& each : costs.instances) whole += each.seconds, radio += each.a_link;
  fmt::print("  CPU time of plugins: {:.3g} s\n", whole);
  for (const InstanceCost& each : costs.instances) {
    if (!(each.seconds > least * whole)) {
      left += each.seconds;
      continue;
    }
    fmt::print("  {:5.1f} %  {:<20} {:<9} {:9.3g} us a step{}\n", 100 * each.seconds / whole, each.instance, each.phase,
               1e6 * each.seconds / static_cast<double>(each.steps),
               each.a_link > 0 ? fmt::format(", {:.3g} ns a link", 1e9 * each.a_link) : "");
  }
  if (left > 0) fmt::print("  {:5.1f} %  the others\n", 100 * left / whole);
  if (radio > 0) fmt::print("  {} links, {:.3g} ns each in all plugins of the radio\n", costs.links, 1e9 * radio);
}

}  // namespace muster::cli
