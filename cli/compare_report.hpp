// What a comparison of runs found, in words and as JSON.
#pragma once

#include <vector>

#include "compared_run.hpp"
#include "text/json.hpp"

namespace muster::cli {

// Columns of one table and unit, in all rows: what one line of a report speaks of. Poses have a line for each of
// distance, heading and tilt.
struct Quantity {
  std::string table, name, unit;  // no name: several columns
  std::string worst_row, worst_column;
  double largest = 0, end = 0;  // absolute
  uint64_t largest_at = 0, first = Course::never, beyond = Course::never;
  uint64_t unlike = 0;          // the most ticks of any row at which nothing can be subtracted
  double tolerance = 0;         // NaN: none
  std::string title() const;    // "robot/*/pose distance [m]"
  std::vector<double> trace{};  // the largest of all in each span of ticks
};

// Those that differ, or have a tolerance: the standard quantities in their order, then what instances observe. `others`
// receives the tables that differ beside them: instances' own state, parts of sums, stages.
std::vector<Quantity> quantities(const Simulation& run, const Divergence& divergence, std::vector<std::string>& others);

// `not_run`: words of runs that could not be made.
void print_comparison(const std::vector<ComparedRun>& runs, const std::vector<std::string>& not_run);
Json comparison_json(const std::vector<ComparedRun>& runs, const std::vector<std::string>& not_run);

}  // namespace muster::cli
