#include "summary.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "text/number.hpp"
#include "text/text_table_writer.hpp"

namespace muster::sweep {
namespace {

std::string short_number(double value) { return std::isnan(value) ? "-" : fmt::format("{:.4g}", value); }

std::string bounds(const Interval& interval) {
  if (std::isnan(interval.low)) return "-";
  return fmt::format("{} .. {}", short_number(interval.low), short_number(interval.high));
}

// Lines of cells, each column as wide as its widest; the first `left` of them begin at its left.
std::string aligned(const std::vector<std::vector<std::string>>& rows, std::size_t left) {
  std::vector<std::size_t> width(rows[0].size(), 0);
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) width[i] = std::max(width[i], row[i].size());
  }
  std::string result;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i)
      line += "  " + (i < left ? fmt::format("{:<{}}", row[i], width[i]) : fmt::format("{:>{}}", row[i], width[i]));
    line.erase(line.find_last_not_of(' ') + 1);
    result += line + '\n';
  }
  return result;
}

Json json_of(const Interval& interval) {
  return {{"count", interval.count},
          {"mean", interval.mean},
          {"deviation", interval.deviation},
          {"low", interval.low},
          {"high", interval.high}};
}

void write_cells(TextTableWriter& table, const Interval& interval) {
  for (const double value : {interval.mean, interval.deviation, interval.low, interval.high}) table.real(value);
}

void write_values(TextTableWriter& table, const Summary& summary, std::size_t combination) {
  table.real(static_cast<double>(combination + 1));
  for (const std::string& value : summary.values[combination]) {
    const auto number = parse_real(value);
    number ? table.real(*number) : table.text(value);
  }
}

std::vector<TextColumn> first_columns(const Summary& summary) {
  std::vector<TextColumn> result{{"combination", ""}};
  for (const std::string& title : summary.varied) result.push_back({title, ""});
  return result;
}

void write_runs(const Summary& summary, const std::vector<DoneJob>& runs, const std::filesystem::path& file) {
  auto columns = first_columns(summary);
  columns.insert(columns.end(), {{"seed", ""}, {"end", "s"}, {"digest", ""}, {"fault", ""}});
  for (const MetricTitle& metric : summary.metrics) columns.push_back({metric.name, metric.unit});
  TextTableWriter table(file, columns);
  for (const DoneJob& run : runs) {
    write_values(table, summary, run.combination);
    table.real(static_cast<double>(run.seed));
    table.real(run.time);
    table.text(run.digest);
    run.fault.empty() ? table.empty() : table.text(run.fault);
    for (const double value : run.values) table.real(value);
    table.end_row();
  }
  table.close();
}

void write_table(const Summary& summary, const std::filesystem::path& file) {
  auto columns = first_columns(summary);
  columns.insert(columns.end(), {{"metric", ""},
                                 {"unit", ""},
                                 {"runs", ""},
                                 {"mean", ""},
                                 {"deviation", ""},
                                 {"low", ""},
                                 {"high", ""},
                                 {"pairs", ""},
                                 {"difference", ""},
                                 {"difference_deviation", ""},
                                 {"difference_low", ""},
                                 {"difference_high", ""}});
  TextTableWriter table(file, columns);
  for (std::size_t c = 0; c < summary.cells.size(); ++c) {
    for (std::size_t m = 0; m < summary.metrics.size(); ++m) {
      const Cell& cell = summary.cells[c][m];
      write_values(table, summary, c);
      table.text(summary.metrics[m].name);
      table.text(summary.metrics[m].unit);
      table.real(static_cast<double>(cell.value.count));
      write_cells(table, cell.value);
      table.real(static_cast<double>(cell.difference.count));
      write_cells(table, cell.difference);
      table.end_row();
    }
  }
  table.close();
}

}  // namespace

Summary summary_of(const SweepFile& sweep, const std::vector<MetricTitle>& metrics, const std::vector<DoneJob>& runs) {
  Summary result;
  result.metrics = metrics;
  for (const Variation& each : sweep.varied) result.varied.push_back(each.title());
  const std::size_t combinations = sweep.combinations(), seeds = sweep.seeds.size();
  result.failed.resize(combinations);
  // A column of a combination and metric: its runs in the order of seeds, so that pairs meet.
  std::vector<std::vector<std::vector<double>>> columns(combinations,
                                                        std::vector(metrics.size(), std::vector<double>()));
  for (std::size_t c = 0; c < combinations; ++c) {
    result.values.emplace_back();
    for (const Word& word : sweep.combination(c)) result.values.back().push_back(word.text);
    for (std::size_t s = 0; s < seeds; ++s) {
      const DoneJob& run = runs.at(c * seeds + s);
      if (!run.fault.empty()) ++result.failed[c];
      for (std::size_t m = 0; m < metrics.size(); ++m) columns[c][m].push_back(run.values.at(m));
    }
    result.cells.emplace_back();
    for (std::size_t m = 0; m < metrics.size(); ++m)
      result.cells.back().push_back(
          {interval_of(columns[c][m]), c == 0 ? interval_of({}) : paired_interval(columns[c][m], columns[0][m])});
  }
  return result;
}

std::string text_of(const Summary& summary) {
  std::string result;
  const bool has_others = summary.cells.size() > 1;
  for (std::size_t m = 0; m < summary.metrics.size(); ++m) {
    std::vector<std::vector<std::string>> rows{{"#"}};
    rows[0].insert(rows[0].end(), summary.varied.begin(), summary.varied.end());
    for (const char* title : {"runs", "mean", "95 % interval", "deviation"}) rows[0].emplace_back(title);
    if (has_others) rows[0].insert(rows[0].end(), {"less #1", "95 % interval"});
    for (std::size_t c = 0; c < summary.cells.size(); ++c) {
      const Cell& cell = summary.cells[c][m];
      std::vector<std::string> row{std::to_string(c + 1)};
      row.insert(row.end(), summary.values[c].begin(), summary.values[c].end());
      row.insert(row.end(), {std::to_string(cell.value.count), short_number(cell.value.mean), bounds(cell.value),
                             short_number(cell.value.deviation)});
      if (has_others) row.insert(row.end(), {short_number(cell.difference.mean), bounds(cell.difference)});
      rows.push_back(std::move(row));
    }
    result += (m > 0 ? "\n" : "") + summary.metrics[m].title() + "\n" + aligned(rows, 1 + summary.varied.size());
  }
  return result;
}

Json json_of(const Summary& summary) {
  Json result = Json::array();
  for (std::size_t c = 0; c < summary.cells.size(); ++c) {
    Json one{{"number", c + 1}, {"values", Json::object()}, {"failed", summary.failed[c]}, {"metrics", Json::array()}};
    for (std::size_t i = 0; i < summary.varied.size(); ++i) one["values"][summary.varied[i]] = summary.values[c][i];
    for (std::size_t m = 0; m < summary.metrics.size(); ++m)
      one["metrics"].push_back({{"name", summary.metrics[m].name},
                                {"unit", summary.metrics[m].unit},
                                {"value", json_of(summary.cells[c][m].value)},
                                {"difference", json_of(summary.cells[c][m].difference)}});
    result.push_back(std::move(one));
  }
  return result;
}

std::vector<std::filesystem::path> write_summary(const Summary& summary, const SweepFile& sweep,
                                                 const std::vector<DoneJob>& runs,
                                                 const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files{folder / "runs.csv", folder / "summary.csv", folder / "summary.svg"};
  write_runs(summary, runs, files[0]);
  write_table(summary, files[1]);
  try {
    save(figure_of(summary, sweep), files[2]);
  } catch (const std::runtime_error& e) {
    throw Error(Exit::io, e.what());
  }
  return files;
}

}  // namespace muster::sweep
