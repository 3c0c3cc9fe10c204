// The picture of a summary.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "summary.hpp"
#include "text/number.hpp"

namespace muster::sweep {
namespace {

using namespace plotting;

// What lies across: of the variations the one with the most values, the first of equals.
std::size_t across(const SweepFile& sweep) {
  const auto fewer = [](const Variation& a, const Variation& b) { return a.values.size() < b.values.size(); };
  return static_cast<std::size_t>(std::max_element(sweep.varied.begin(), sweep.varied.end(), fewer) -
                                  sweep.varied.begin());
}

struct Ends {
  Line line;
  ErrorBars bars;
};

void add(Ends& ends, double x, const Interval& interval) {
  ends.line.x.push_back(x);
  ends.line.y.push_back(interval.mean);
  ends.bars.x.push_back(x);
  ends.bars.y.push_back(interval.mean);
  ends.bars.low.push_back(interval.low);
  ends.bars.high.push_back(interval.high);
}

std::string label_of(const Summary& summary, std::size_t combination, std::size_t left_out) {
  std::string result;
  for (std::size_t i = 0; i < summary.varied.size(); ++i) {
    if (i != left_out) result += (result.empty() ? "" : ", ") + summary.values[combination][i];
  }
  return result;
}

// The axis of values: numbers where all are, names otherwise.
Axis axis_of(const SweepFile& sweep, std::size_t varied, std::vector<double>& at) {
  Axis result;
  if (sweep.varied.empty()) {
    result.names = {sweep.name()};
    at = {0};
    return result;
  }
  const Variation& variation = sweep.varied[varied];
  result.label = variation.title();
  for (const Word& word : variation.values) {
    if (const auto number = parse_real(word.text)) at.push_back(*number);
  }
  if (at.size() == variation.values.size() && at.size() > 1) {
    const auto [least, most] = std::minmax_element(at.begin(), at.end());
    const double margin = 0.04 * (*most - *least);  // bars at the ends are inside
    result.from = *least - margin;
    result.to = *most + margin;
    return result;
  }
  at.clear();
  for (const Word& word : variation.values) {
    at.push_back(static_cast<double>(at.size()));
    result.names.push_back(word.text);
  }
  return result;
}

Panel panel_of(const Summary& summary, const SweepFile& sweep, std::size_t metric, Interval Cell::*which) {
  const bool is_difference = which == &Cell::difference;
  Panel panel{.title = summary.metrics[metric].name + (is_difference ? ", less the first" : "")};
  panel.y = {.label = is_difference ? "difference" : "mean", .unit = summary.metrics[metric].unit};
  const std::size_t varied = across(sweep);
  std::vector<double> at;
  panel.x = axis_of(sweep, varied, at);
  std::size_t inner = 1;  // combinations from one value of the axis to its next
  for (std::size_t i = varied + 1; i < sweep.varied.size(); ++i) inner *= sweep.varied[i].values.size();
  std::size_t series = 0;
  for (std::size_t first = 0; first < summary.cells.size(); ++first) {
    if (first / inner % at.size() != 0) continue;
    Ends ends;
    ends.line.label = label_of(summary, first, varied);
    ends.line.colour = ends.bars.colour = series_colour(series++);
    for (std::size_t i = 0; i < at.size(); ++i) {
      Interval shown = summary.cells[first + i * inner][metric].*which;
      if (is_difference && first + i * inner == 0) shown.mean = shown.low = shown.high = 0;
      add(ends, at[i], shown);
    }
    Points points{.x = ends.line.x, .y = ends.line.y, .colour = ends.line.colour, .radius = 3};
    panel.layers.emplace_back(std::move(ends.bars));
    panel.layers.emplace_back(std::move(ends.line));
    panel.layers.emplace_back(std::move(points));
  }
  panel.legend = series > 1;
  if (is_difference) panel.layers.emplace_back(Rule{.at = 0});
  return panel;
}

}  // namespace

Figure figure_of(const Summary& summary, const SweepFile& sweep) {
  const bool has_others = summary.cells.size() > 1;
  Figure result{.title = sweep.name(),
                .caption = fmt::format("Means over {} seeds with their 95 % intervals; differences from the first "
                                       "combination are taken seed by seed.",
                                       sweep.seeds.size()),
                .columns = has_others ? 2 : 1,
                .width = has_others ? 1200.0 : 700.0};
  for (std::size_t m = 0; m < summary.metrics.size(); ++m) {
    result.panels.push_back(panel_of(summary, sweep, m, &Cell::value));
    if (has_others) result.panels.push_back(panel_of(summary, sweep, m, &Cell::difference));
  }
  return result;
}

}  // namespace muster::sweep
