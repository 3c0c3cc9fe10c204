#include "ladder_run.hpp"

#include <fmt/core.h>

#include <algorithm>
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

// What is set of the world's instances, as attributes of theirs: a rung sets some of them after that, which a run that
// is set later would undo. `words` keeps what is set of others, such as materials. All was set once, and so is valid.
World with_set(World world, LadderWords& words) {
  std::erase_if(words.set, [&](const std::string& one) {
    const auto equals = one.find('='), slash = one.rfind('/', equals);
    const auto owner =
        std::find_if(world.instances.begin(), world.instances.end(),
                     [&](const InstanceDeclaration& instance) { return instance.name == one.substr(0, slash); });
    if (owner == world.instances.end()) return false;
    const std::string name = one.substr(slash + 1, equals - slash - 1);
    std::erase_if(owner->attributes, [&](const XmlAttribute& given) { return given.name == name; });
    owner->attributes.push_back({name, one.substr(equals + 1), {"--set"}, {"--set"}});
    return true;
  });
  return world;
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

void print(const std::string& title, const std::vector<Outcome>& outcomes, const std::vector<Metric>& metrics) {
  if (outcomes.empty()) return;
  fmt::print("{}, to t = {} s, by rung of the ladder\n\n{:<14}", title, print_real(outcomes[0].time), "rung");
  for (const Metric& metric : metrics) fmt::print("  {:>12}", metric.title());
  fmt::print("  made by\n");
  for (const Outcome& outcome : outcomes) {
    fmt::print("{:<14}", outcome.rung.name);
    for (std::size_t i = 0; i < metrics.size(); ++i)
      fmt::print("  {:>{}}", cell(outcome.values[i]), std::max<std::size_t>(12, metrics[i].title().size()));
    fmt::print("  {}\n", outcome.rung.change);
  }
}

Json json(const std::vector<Outcome>& outcomes, const std::vector<Metric>& metrics) {
  Json result = Json::array();
  for (const Outcome& outcome : outcomes) {
    Json rung{{"rung", outcome.rung.name},
              {"made_by", outcome.rung.change},
              {"time", outcome.time},
              {"digest", hexadecimal(outcome.digest)}};
    for (std::size_t i = 0; i < metrics.size(); ++i) {
      rung["metrics"].push_back({{"name", metrics[i].name}, {"unit", metrics[i].unit}, {"value", outcome.values[i]}});
    }
    result.push_back(std::move(rung));
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

Exit run_ladder(LadderWords words) {
  World world = world_of(words.world, words);
  std::vector<Rung> rungs;
  std::vector<Metric> metrics;
  std::size_t channels = 0;
  {
    const auto given = made(world, words);
    world = with_set(std::move(world), words);
    rungs = ladder(world, *given);
    channels = rungs.size();
    for (Rung& body : ladder_of_bodies(world, *given, words.measured)) rungs.push_back(std::move(body));
    if (!rungs.empty()) metrics = metrics_of(words, *given);
    given->close();
  }
  if (rungs.empty())
    throw Error(
        Exit::invalid_input,
        "muster compare --ladder: the world has neither a radio.multiwall, whose model the first rungs set, nor a "
        "physics, which the others exchange");
  Progress progress("muster compare --ladder " + world.name);
  watch_interrupt();
  std::vector<Outcome> of_channels, of_bodies;
  std::vector<std::string> left_out;
  const double share = 1.0 / static_cast<double>(rungs.size());
  for (std::size_t i = 0; i < rungs.size(); ++i) {
    const bool is_body = i >= channels;
    const std::string name = rungs[i].name;
    try {
      Outcome outcome = climb(std::move(rungs[i]), metrics, words, progress, share * static_cast<double>(i), share);
      (is_body ? of_bodies : of_channels).push_back(std::move(outcome));
    } catch (const Error& e) {  // a body that a robot of this world cannot have
      if (!is_body || e.exit() != Exit::invalid_input || name == "measured") throw;
      left_out.push_back(name + ": " + e.what());
    }
    if (interrupted()) return Exit::interrupted;
  }
  if (words.json) {
    const Json told{{"world", world.name},
                    {"rungs", json(of_channels, metrics)},
                    {"bodies", json(of_bodies, metrics)},
                    {"left_out", left_out}};
    fmt::print("{}\n", told.dump(2));
  } else {
    print(world.name, of_channels, metrics);
    if (!of_channels.empty() && !of_bodies.empty()) fmt::print("\n");
    print(world.name + " with other bodies", of_bodies, metrics);
    for (const std::string& each : left_out) fmt::print("  left out: {}\n", each);
  }
  std::fflush(stdout);
  if (words.out.empty()) return Exit::done;
  std::vector<Outcome> all = std::move(of_channels);
  for (Outcome& each : of_bodies) all.push_back(std::move(each));
  write(words.out, world.name, all, metrics);
  return Exit::done;
}

}  // namespace muster::cli
