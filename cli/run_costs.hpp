// What the plugins of a run cost: CPU time by instance, and a link's where a plugin is of the radio.
#pragma once

#include <string>
#include <vector>

#include "kernel/simulation.hpp"
#include "text/json.hpp"

namespace muster::cli {

struct InstanceCost {
  std::string instance, plugin, phase;
  double seconds = 0;  // CPU time of the threads that step; threads of a plugin's own are not counted
  uint64_t steps = 0;
  double a_link = 0;  // s, of a link and step; 0 of what is not of the radio
};
struct RunCosts {
  std::size_t links = 0;                  // at the end
  std::vector<InstanceCost> instances{};  // the dearest first
};

// Of a run with Options::costs.
RunCosts costs_of(const Simulation& run);

Json json_of(const RunCosts& costs);
// As lines of a table; instances of less than half a per cent of the whole are summed up.
void print(const RunCosts& costs);

}  // namespace muster::cli
