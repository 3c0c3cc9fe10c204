#include "diagnosis/data/clock.hpp"

#include <algorithm>
#include <cmath>

#include "diagnosis/data/median.hpp"
#include "diagnosis/data/thresholds.hpp"
#include "text/names.hpp"
#include "text/number.hpp"

namespace muster::diagnosis {
namespace {

bool counts_rows(const std::vector<double>& values) {
  if (values.size() < 2 || values[0] != std::round(values[0])) return false;
  for (std::size_t row = 1; row < values.size(); ++row) {
    if (values[row] != values[row - 1] + 1) return false;
  }
  return true;
}

std::shared_ptr<const TextTable> without_clock(const TextTable& table, std::size_t column, std::vector<double> values,
                                               std::vector<std::string>& notes) {
  notes.push_back(
      "t has no unit and counts rows: taken as no clock, so nothing is tested in time; if a row was measured each "
      "second, "
      "call it t[s]");
  std::string name = "row_number";
  while (table.find(name)) name += '_';
  return std::make_shared<const TextTable>(table.with_column(column, {name, ""}, std::move(values)));
}

}  // namespace

double unit_of_clock(double stamp) {
  const double size = std::abs(stamp);
  return size < 1e11 ? 1 : size < 1e14 ? 1e-3 : size < 1e17 ? 1e-6 : 1e-9;
}

std::string name_of_unit(double seconds) {
  return seconds == 1 ? "seconds" : seconds == 1e-3 ? "milliseconds" : seconds == 1e-6 ? "microseconds" : "nanoseconds";
}

std::shared_ptr<const TextTable> with_clock_in_seconds(std::shared_ptr<const TextTable> table,
                                                       std::vector<std::string>& notes) {
  const auto column = table->find("t");
  if (!column || table->rows() == 0) return table;
  const std::string& unit = table->columns()[*column].unit;
  if (unit.empty() && table->is_numeric(*column)) {
    std::vector<double> values = table->reals(*column);
    if (counts_rows(values)) return without_clock(*table, *column, std::move(values), notes);
  }
  std::vector<double> t = table->reals(table->require("t", "s"));
  if (counts_rows(t))
    notes.push_back(
        "t[s] rises by one second from row to row: taken as a clock, since it has a unit; if it counts rows, call it t "
        "without a unit");
  const double middle = median(t), seconds = unit_of_clock(middle);
  if (seconds == 1) return table;
  notes.push_back("t[s] has values such as " + print_real(middle) + ": read as " + name_of_unit(seconds) +
                  " since 1970, not as seconds");
  for (double& v : t) v *= seconds;
  return std::make_shared<const TextTable>(table->with_column(*column, {"t", "s"}, std::move(t)));
}

std::vector<std::size_t> wild_stamps(const std::vector<double>& t) {
  std::vector<std::size_t> wild;
  if (t.size() < thresholds::fewest_stamps) return wild;
  std::vector<double> sorted = t;
  std::sort(sorted.begin(), sorted.end());
  const std::size_t end = sorted.size() / 20;
  const double low = sorted[end], high = sorted[sorted.size() - 1 - end];
  const double farthest = std::max(thresholds::wild_distance, thresholds::wild_ranges * (high - low));
  for (std::size_t row = 0; row < t.size(); ++row) {
    if (t[row] < low - farthest || t[row] > high + farthest) wild.push_back(row);
  }
  if (wild.size() > std::max<std::size_t>(1, t.size() / thresholds::stamps_of_wild)) wild.clear();
  return wild;
}

}  // namespace muster::diagnosis
