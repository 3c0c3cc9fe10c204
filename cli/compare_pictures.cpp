#include "compare_pictures.hpp"

#include <algorithm>
#include <cmath>

#include "compare_report.hpp"
#include "diagnosis/radio/links/floor_plan.hpp"

namespace muster::cli {
namespace {

constexpr std::size_t most_robots = 12, most_lines = 6, most_panels = 5;

// What people look at first; the others follow in the order of the standard sets.
const std::vector<std::string> first_of_all = {"robot/*/pose distance [m]", "robot/*/pose heading [rad]",
                                               "link/*/level [dB]",         "link/*/rssi [dB]",
                                               "inbox/*/message count",     "robot/*/twist [m/s]"};

plotting::Line line_of(const std::vector<double>& trace, const Divergence& divergence, double dt, std::string label) {
  plotting::Line line{.label = std::move(label)};
  const double span = static_cast<double>(divergence.span()) * dt;
  for (std::size_t i = 0; i <= divergence.tick() / divergence.span(); ++i) {
    line.x.push_back(static_cast<double>(i) * span);
    line.y.push_back(i < trace.size() ? trace[i] : 0);
  }
  return line;
}

// The first run's ways wide and grey, the others' thin and coloured on top of them.
std::optional<plotting::Panel> ways_panel(const std::vector<ComparedRun>& runs) {
  if (runs[0].ways.empty() || runs[0].ways.size() > most_robots) return {};
  plotting::Panel panel{.title = "ways of the robots",
                        .x = {.label = "x", .unit = "m"},
                        .y = {.label = "y", .unit = "m"},
                        .equal = true,
                        .legend = true};
  panel.layers.push_back(plan_of(*runs[0].run));
  for (std::size_t i = 0; i < runs.size(); ++i) {
    for (const auto& [robot, way] : runs[i].ways) {
      plotting::Line line{.colour = i == 0 ? plotting::light_grey : plotting::series_colour(i - 1),
                          .width = i == 0 ? 5 : 1.2};
      for (const auto& at : way) line.x.push_back(at.x), line.y.push_back(at.y);
      if (&way == &runs[i].ways.begin()->second) line.label = runs[i].label + ": " + runs[i].what;
      panel.layers.push_back(line);
    }
  }
  return panel;
}

plotting::Panel quantity_panel(const std::vector<ComparedRun>& runs, const Quantity& shown) {
  plotting::Panel panel{.title = shown.table + (shown.name.empty() ? "" : ' ' + shown.name),
                        .x = {.label = "time", .unit = "s"},
                        .y = {.label = "difference", .unit = shown.unit, .from = 0.0}};
  const double dt = runs[0].run->world().dt;
  for (std::size_t i = 1; i < runs.size(); ++i) {
    if (!runs[i].divergence) continue;
    const Divergence& divergence = *runs[i].divergence;
    const TableDivergence& table = divergence.tables().at(shown.table);
    if (runs.size() == 2 && table.by_row && table.rows.size() > 1 && table.rows.size() <= most_lines) {
      const auto measure = static_cast<std::size_t>(std::find_if(table.measures.begin(), table.measures.end(),
                                                                 [&](const auto& m) { return m.name == shown.name; }) -
                                                    table.measures.begin());
      for (const auto& [row, courses] : table.rows)
        panel.layers.push_back(line_of(courses[measure].trace, divergence, dt, row));
      continue;
    }
    std::vector<std::string> others;
    auto line = line_of({}, divergence, dt, runs[i].label);
    for (const Quantity& q : quantities(*runs[0].run, divergence, others)) {
      if (q.title() == shown.title()) line = line_of(q.trace, divergence, dt, runs[i].label);
    }
    line.colour = plotting::series_colour(i - 1);
    panel.layers.push_back(line);
  }
  if (!std::isnan(shown.tolerance)) panel.layers.push_back(plotting::Rule{.at = shown.tolerance, .label = "tolerance"});
  return panel;
}

std::vector<Quantity> chosen(const std::vector<ComparedRun>& runs) {
  std::vector<Quantity> result;
  for (const auto& r : runs) {
    std::vector<std::string> others;
    if (!r.divergence) continue;
    for (const Quantity& q : quantities(*runs[0].run, *r.divergence, others)) {
      const bool known =
          std::any_of(result.begin(), result.end(), [&](const Quantity& k) { return k.title() == q.title(); });
      if (q.largest > 0 && !known) result.push_back(q);
    }
  }
  const auto rank = [](const Quantity& q) {
    return std::find(first_of_all.begin(), first_of_all.end(), q.title()) - first_of_all.begin();
  };
  std::stable_sort(result.begin(), result.end(), [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
  result.resize(std::min(result.size(), most_panels));
  return result;
}

}  // namespace

plotting::Figure comparison_figure(const std::vector<ComparedRun>& runs) {
  plotting::Figure figure{.title = runs[0].run->world().name,
                          .caption = "Against " + runs[0].label + " (" + runs[0].what +
                                     "): the largest difference of all rows and columns in each span of time.",
                          .columns = 2,
                          .width = 1000};
  const auto all = chosen(runs);
  if (all.empty()) return figure;
  if (auto ways = ways_panel(runs)) figure.panels.push_back(*ways);
  for (const Quantity& q : all) figure.panels.push_back(quantity_panel(runs, q));
  return figure;
}

}  // namespace muster::cli
