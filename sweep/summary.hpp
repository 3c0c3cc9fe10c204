// What came of a sweep: of each combination and metric the mean over seeds with its interval, and the paired difference
// from the first combination. The same bytes from the same runs, whoever did them in which order.
#pragma once

#include "interval.hpp"
#include "job_table.hpp"
#include "plotting/figure.hpp"
#include "sweep_file.hpp"
#include "text/json.hpp"

namespace muster::sweep {

struct Cell {
  Interval value;
  Interval difference;  // from the first combination, seed by seed; of the first itself: without a count
};

struct Summary {
  std::vector<std::string> varied;               // titles, as columns
  std::vector<std::vector<std::string>> values;  // of each combination
  std::vector<MetricTitle> metrics;
  std::vector<std::vector<Cell>> cells;  // of each combination, a metric
  std::vector<std::size_t> failed;       // runs of each combination
};

// All runs of the table, which are done.
Summary summary_of(const SweepFile& sweep, const std::vector<MetricTitle>& metrics, const std::vector<DoneJob>& runs);

std::string text_of(const Summary& summary);
Json json_of(const Summary& summary);
// A panel for the values and one for the differences of each metric. Across: what has the most values; a line for each
// combination of the rest.
plotting::Figure figure_of(const Summary& summary, const SweepFile& sweep);

// runs.csv, summary.csv and summary.svg; the files written. Throws Error.
std::vector<std::filesystem::path> write_summary(const Summary& summary, const SweepFile& sweep,
                                                 const std::vector<DoneJob>& runs, const std::filesystem::path& folder);

}  // namespace muster::sweep
