#include "ladder_run.hpp"

#include <fmt/core.h>

#include <cmath>

#include "ladder.hpp"
#include "plotting/figure.hpp"
#include "run_metrics.hpp"
#include "text/json.hpp"
#include "text/number.hpp"
#include "text/text_table_writer.hpp"

namespace muster::cli {
namespace {

struct Outcome {
  Rung rung;
  double time = 0;  // s
  uint64_t digest = 0;
  std::vector<double> values{};  // a metric
};

std::vector<Metric> metrics_of(const LadderWords& words, const Simulation& given) {
  std::vector<Metric> result;
  for (const auto& word : words.metrics) result.push_back(metric_of(word, given, "--metric"));
  if (result.empty()) result = usual_metrics(given);
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
  const auto run = made(rung.world, words);
  const Positions at_start = robot_positions(*run);
  while (!run->done() && !interrupted()) {
    run->step();
    progress.at(done + share * run->time() / (static_cast<double>(rung.world.ticks) * rung.world.dt));
  }
  Outcome result{std::move(rung), run->time(), run->digest()};
  for (const Metric& metric : metrics) result.values.push_back(metric.value(*run, at_start));
  run->close();
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
