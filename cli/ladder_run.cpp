#include "ladder_run.hpp"

#include <fmt/core.h>

#include <cmath>
#include <functional>
#include <limits>

#include "ladder.hpp"
#include "plotting/figure.hpp"
#include "text/json.hpp"
#include "text/names.hpp"
#include "text/number.hpp"
#include "text/text_table_writer.hpp"

namespace muster::cli {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

// A number of a whole run, NaN where there is none.
struct Metric {
  std::string name, unit;
  std::function<double(const Simulation& run, const Simulation& at_start)> value;
  std::string title() const { return name + (unit.empty() ? "" : " [" + unit + ']'); }
};

struct Outcome {
  Rung rung;
  double time = 0;  // s
  uint64_t digest = 0;
  std::vector<double> values{};  // a metric
};

// How far robots got from where they began, on average.
double moved(const Simulation& run, const Simulation& at_start) {
  const TableView now = run.table("robot/*/pose"), before = at_start.table("robot/*/pose");
  double sum = 0;
  const std::size_t robots = std::min(now.rows(), before.rows());
  for (std::size_t i = 0; i < robots; ++i) {
    sum += std::hypot(now.at(i, 0) - before.at(i, 0), now.at(i, 1) - before.at(i, 1), now.at(i, 2) - before.at(i, 2));
  }
  return robots > 0 ? sum / static_cast<double>(robots) : nothing;
}

std::size_t column_of(const TableView& table, const std::string& path, const std::string& name) {
  std::vector<std::string> valid;
  for (std::size_t c = 0; c < table.cols(); ++c) {
    valid.push_back(table.table->columns()[c].name);
    if (valid.back() == name) return c;
  }
  throw Error(Exit::invalid_input,
              "--metric: " + quote(path) + " has no column " + quote(name) + "; " + suggest(name, valid));
}

// Of the copies of messages that were asked for, how many arrived.
double delivered(const Simulation& run, const Simulation&) {
  const TableView traffic = run.table("radio/*/traffic");
  const std::size_t asked = column_of(traffic, "radio/*/traffic", "asked");
  const std::size_t arrived = column_of(traffic, "radio/*/traffic", "delivered");
  double of_all = 0, sum = 0;
  for (std::size_t i = 0; i < traffic.rows(); ++i) of_all += traffic.at(i, asked), sum += traffic.at(i, arrived);
  return of_all > 0 ? sum / of_all : nothing;
}

// "robot/leader/pose/x": a column of a table in the end, on average over its rows.
Metric metric_of(const std::string& word, const Simulation& given) {
  const auto slash = word.rfind('/');
  if (slash == std::string::npos)
    throw Error(Exit::invalid_input,
                "--metric " + quote(word) + ": expected TABLE/COLUMN, such as robot/leader/pose/x");
  const std::string path = word.substr(0, slash), name = word.substr(slash + 1);
  const TableView table = given.table(path);
  const std::string unit = table.table->columns()[column_of(table, path, name)].unit;
  return {word, unit, [path, name](const Simulation& run, const Simulation&) {
            const TableView now = run.table(path);
            const std::size_t column = column_of(now, path, name);
            double sum = 0;
            for (std::size_t row = 0; row < now.rows(); ++row) sum += now.at(row, column);
            return now.rows() > 0 ? sum / static_cast<double>(now.rows()) : nothing;
          }};
}

std::vector<Metric> metrics_of(const LadderWords& words, const Simulation& given) {
  std::vector<Metric> result;
  for (const auto& word : words.metrics) result.push_back(metric_of(word, given));
  if (!result.empty()) return result;
  if (given.table("robot/*/pose").rows() > 0) result.push_back({"moved", "m", moved});
  if (given.board().find("radio/*/traffic")) result.push_back({"delivered", "", delivered});
  if (result.empty())
    throw Error(Exit::invalid_input,
                "muster compare --ladder: the world has neither robots nor messages; expected --metric TABLE/COLUMN");
  return result;
}

std::unique_ptr<Simulation> made(const World& world, const LadderWords& words) {
  auto run = std::make_unique<Simulation>(world, standard(), Options{plugin_path(words.plugins), words.workers, {}});
  set_parameters(*run, words.set);
  return run;
}

Outcome climb(Rung rung, const std::vector<Metric>& metrics, const LadderWords& words, Progress& progress, double done,
              double share) {
  const auto run = made(rung.world, words), at_start = made(rung.world, words);
  while (!run->done() && !interrupted()) {
    run->step();
    progress.at(done + share * run->time() / (static_cast<double>(rung.world.ticks) * rung.world.dt));
  }
  Outcome result{std::move(rung), run->time(), run->digest()};
  for (const Metric& metric : metrics) result.values.push_back(metric.value(*run, *at_start));
  run->close();
  at_start->close();
  return result;
}

std::string cell(double value) { return std::isnan(value) ? "-" : fmt::format("{:.4g}", value); }

void print(const std::string& world, const std::vector<Outcome>& outcomes, const std::vector<Metric>& metrics) {
  fmt::print("{}, to t = {} s, by rung of the ladder\n\n{:<14}", world, print_real(outcomes[0].time), "rung");
  for (const Metric& metric : metrics) fmt::print("  {:>12}", metric.title());
  fmt::print("  made by\n");
  for (const Outcome& outcome : outcomes) {
    fmt::print("{:<14}", outcome.rung.name);
    for (std::size_t i = 0; i < metrics.size(); ++i)
      fmt::print("  {:>{}}", cell(outcome.values[i]), std::max<std::size_t>(12, metrics[i].title().size()));
    fmt::print("  {}\n", outcome.rung.change);
  }
}

Json json(const std::string& world, const std::vector<Outcome>& outcomes, const std::vector<Metric>& metrics) {
  Json result{{"world", world}, {"rungs", Json::array()}};
  for (const Outcome& outcome : outcomes) {
    Json rung{{"rung", outcome.rung.name},
              {"made_by", outcome.rung.change},
              {"time", outcome.time},
              {"digest", hexadecimal(outcome.digest)}};
    for (std::size_t i = 0; i < metrics.size(); ++i) {
      rung["metrics"].push_back({{"name", metrics[i].name}, {"unit", metrics[i].unit}, {"value", outcome.values[i]}});
    }
    result["rungs"].push_back(std::move(rung));
  }
  return result;
}

void write(const std::filesystem::path& folder, const std::string& world, const std::vector<Outcome>& outcomes,
           const std::vector<Metric>& metrics) {
  std::filesystem::create_directories(folder);
  TextTableWriter table(folder / "ladder.csv", {{"rung", ""}, {"metric", ""}, {"unit", ""}, {"value", ""}});
  plotting::Figure figure{.title = world,
                          .caption = "In the end of the run, with the same random numbers on each rung.",
                          .columns = metrics.size() > 1 ? 2 : 1,
                          .width = metrics.size() > 1 ? 1200.0 : 700.0};
  for (std::size_t i = 0; i < metrics.size(); ++i) {
    plotting::Panel panel{.title = metrics[i].name, .y = {.label = metrics[i].name, .unit = metrics[i].unit}};
    plotting::Line line{.colour = plotting::light_grey};
    for (const Outcome& outcome : outcomes) {
      table.text(outcome.rung.name);
      table.text(metrics[i].name);
      table.text(metrics[i].unit);
      table.real(outcome.values[i]);
      table.end_row();
      panel.x.names.push_back(outcome.rung.name);
      line.x.push_back(static_cast<double>(line.x.size()));
      line.y.push_back(outcome.values[i]);
    }
    panel.layers = {line, plotting::Points{.x = line.x, .y = line.y, .radius = 4}};
    figure.panels.push_back(std::move(panel));
  }
  table.close();
  try {
    save(figure, folder / "ladder.svg");
  } catch (const std::runtime_error& e) {
    throw Error(Exit::io, e.what());
  }
}

}  // namespace

Exit run_ladder(const LadderWords& words) {
  const World world = world_of(words.world, words);
  std::vector<Rung> rungs;
  std::vector<Metric> metrics;
  {
    const auto given = made(world, words);
    rungs = ladder(world, *given);
    metrics = metrics_of(words, *given);
    given->close();
  }
  Progress progress("muster compare --ladder " + world.name);
  watch_interrupt();
  std::vector<Outcome> outcomes;
  const double share = 1.0 / static_cast<double>(rungs.size());
  for (Rung& rung : rungs) {
    outcomes.push_back(
        climb(std::move(rung), metrics, words, progress, share * static_cast<double>(outcomes.size()), share));
    if (interrupted()) return Exit::interrupted;
  }
  if (words.json)
    fmt::print("{}\n", json(world.name, outcomes, metrics).dump(2));
  else
    print(world.name, outcomes, metrics);
  std::fflush(stdout);
  if (!words.out.empty()) write(words.out, world.name, outcomes, metrics);
  return Exit::done;
}

}  // namespace muster::cli
