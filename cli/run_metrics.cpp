#include "run_metrics.hpp"

#include <cmath>

#include "kernel/occasions.hpp"
#include "text/names.hpp"

namespace muster::cli {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

// A row that has left keeps its last cells, which are no value of the run any more.
bool is_here(const TableView& table, std::size_t row) {
  const Set& set = table.table->set();
  return !set.is_named() || set.alive[table.row >= 0 ? static_cast<std::size_t>(table.row) : row];
}

// How far robots got from where they began, on average over those that have not left.
double moved(const Simulation& run, const Positions& at_start) {
  const TableView poses = run.table("robot/*/pose");
  const Positions now = robot_positions(run);
  double sum = 0;
  std::size_t robots = 0;
  for (std::size_t i = 0; i < std::min(now.size(), at_start.size()); ++i) {
    if (!is_here(poses, i)) continue;
    sum += std::hypot(now[i][0] - at_start[i][0], now[i][1] - at_start[i][1], now[i][2] - at_start[i][2]);
    ++robots;
  }
  return robots > 0 ? sum / static_cast<double>(robots) : nothing;
}

std::size_t column_of(const Simulation& run, const TableView& table, const std::string& path, const std::string& name,
                      const std::string& option) {
  std::vector<std::string> valid;
  for (std::size_t c = 0; c < table.cols(); ++c) {
    valid.push_back(table.table->columns()[c].name);
    if (valid.back() == name) return c;
  }
  throw Error(Exit::invalid_input, option + ": " + quote(path) + " has no column " + quote(name) + "; " +
                                       suggest(name, valid) + column_elsewhere(run.board(), *table.table, name));
}

// Of the copies of messages that were asked for, how many arrived; also of radios that have left since.
double delivered(const Simulation& run, const Positions&) {
  const TableView traffic = run.table("radio/*/traffic");
  const std::size_t asked = column_of(run, traffic, "radio/*/traffic", "asked", "delivered");
  const std::size_t arrived = column_of(run, traffic, "radio/*/traffic", "delivered", "delivered");
  double of_all = 0, sum = 0;
  for (std::size_t i = 0; i < traffic.rows(); ++i) of_all += traffic.at(i, asked), sum += traffic.at(i, arrived);
  return of_all > 0 ? sum / of_all : nothing;
}

}  // namespace

Positions robot_positions(const Simulation& run) {
  Positions result;
  const TableView poses = run.table("robot/*/pose");
  for (std::size_t i = 0; i < poses.rows(); ++i) result.push_back({poses.at(i, 0), poses.at(i, 1), poses.at(i, 2)});
  return result;
}

std::vector<Metric> usual_metrics(const Simulation& given) {
  std::vector<Metric> result;
  if (given.table("robot/*/pose").rows() > 0) result.push_back({"moved", "m", moved});
  if (given.board().find("radio/*/traffic")) result.push_back({"delivered", "", delivered});
  return result;
}

Metric metric_of(const std::string& word, const Simulation& given, const std::string& option) {
  const auto slash = word.rfind('/');
  if (slash == std::string::npos)
    throw Error(Exit::invalid_input,
                option + ' ' + quote(word) + ": expected TABLE/COLUMN, such as robot/leader/pose/x");
  const std::string path = word.substr(0, slash), name = word.substr(slash + 1);
  const TableView table = given.table(path);
  const std::string unit = table.table->columns()[column_of(given, table, path, name, option)].unit;
  return {word, unit, [path, name, option](const Simulation& run, const Positions&) {
            const auto now = run.find_table(path);
            if (!now) return nothing;
            const std::size_t column = column_of(run, *now, path, name, option);
            double sum = 0;
            std::size_t rows = 0;
            for (std::size_t row = 0; row < now->rows(); ++row) {
              if (is_here(*now, row) && !std::isnan(now->at(row, column))) sum += now->at(row, column), ++rows;
            }
            return rows > 0 ? sum / static_cast<double>(rows) : nothing;
          }};
}

}  // namespace muster::cli
