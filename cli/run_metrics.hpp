// What one number is measured of a whole run: how far robots moved, how many messages arrived, a column of a table.
#pragma once

#include <array>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "kernel/simulation.hpp"
#include "text/error.hpp"

namespace muster::cli {

// Where robots are, row by row.
using Positions = std::vector<std::array<double, 3>>;
Positions robot_positions(const Simulation& run);

// NaN where a run has none.
struct Metric {
  std::string name, unit;
  std::function<double(const Simulation& run, const Positions& at_start)> value;
  std::string title() const { return name + (unit.empty() ? "" : " [" + unit + ']'); }
};

// "moved", how far robots that have not left got on average, and "delivered", which share of messages arrived, as far
// as the world has robots and messages.
std::vector<Metric> usual_metrics(const Simulation& given);

// "robot/leader/pose/x": a column of a table, on average over its rows that have a value, which those that have left
// have not; `option` gave the word, for messages. Throws Error.
Metric metric_of(const std::string& word, const Simulation& given, const std::string& option);

}  // namespace muster::cli
