#include "sweep_runs.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "bundle_run.hpp"
#include "exchange.hpp"
#include "run_options.hpp"
#include "text/names.hpp"
#include "text/number.hpp"
#include "text/unit_words.hpp"
#include "verbs.hpp"
#include "world_file/kinds.hpp"

namespace muster::cli {
namespace {

using sweep::Over;
using sweep::Variation;
using sweep::Word;

// What is refused without a place is told with the one in the sweep's file.
template <class Call>
auto told_at(const Place& place, Call&& call) {
  try {
    return call();
  } catch (const Error& e) {
    if (!e.place().file.empty() || e.message().starts_with(place.text())) throw;
    throw Error(e.exit(), place, e.message());
  }
}

std::string title_of(const sweep::MetricDeclaration& declared) {
  static constexpr const char* before[] = {"", "mean of ", "least of ", "most of "};  // in the order of Over
  return before[static_cast<std::size_t>(declared.over)] + declared.of.text;
}

Metric metric_named(const Word& word, const Simulation& run) {
  if (word.text.find('/') != std::string::npos)
    return told_at(word.place, [&] { return metric_of(word.text, run, word.place.text()); });
  std::vector<std::string> names;
  for (Metric& usual : usual_metrics(run)) {
    if (usual.name == word.text) return std::move(usual);
    names.push_back(usual.name);
  }
  throw invalid(word.place, "there is no metric " + quote(word.text) + "; " + suggest(word.text, names) +
                                ", or TABLE/COLUMN such as robot/leader/pose/x");
}

void exchange_plugin(World& world, const Variation& variation, const Word& word,
                     const std::vector<std::string>& instances) {
  if (std::find(instances.begin(), instances.end(), variation.path) == instances.end())
    throw invalid(variation.place, "no instance of " + world.file.string() + " is called " + quote(variation.path) +
                                       which_is(world, variation.path, "instance") + "; " +
                                       suggest(variation.path, instances) +
                                       plugin_hint(variation.path, whose_plugin(world.instances, variation.path)));
  exchange(world, exchange_of(variation.path, word.text), instances, word.place.text());
}

}  // namespace

void SweepRuns::TimedMetric::look(const Simulation& run, const Positions& at_start) {
  if (over == Over::end) return;
  const double now = metric.value(run, at_start);
  if (std::isnan(now)) return;
  const bool is_first = ticks++ == 0;
  if (over == Over::mean)
    so_far = is_first ? now : so_far + now;
  else if (is_first || (over == Over::least ? now < so_far : now > so_far))
    so_far = now;
}

double SweepRuns::TimedMetric::value(const Simulation& run, const Positions& at_start) const {
  if (over == Over::end) return metric.value(run, at_start);
  return over == Over::mean ? so_far / ticks : so_far;
}

World SweepRuns::world_of(const std::vector<Word>& values) {
  Word place = file_.world;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (file_.varied[i].kind == Variation::Kind::world) place = values[i];
  }
  if (!std::filesystem::exists(file_.beside(place.text)))
    throw invalid(place.place, quote(place.text) +
                                   " is not there; expected a world's folder or file, from the folder of " +
                                   file_.file.string());
  World world = read_world(file_.beside(place.text), standard());
  if (!file_.until) return world;
  const auto until = parse_real(file_.until->text);
  if (!until)
    throw invalid(file_.until->place, "until: " + why_not_real(file_.until->text) + "; expected seconds" +
                                          other_unit_hint("s", file_.until->text));
  world.ticks = ticks_of(*until, world.dt, file_.until->place);
  return world;
}

const std::vector<std::string>& SweepRuns::instances_of(const World& world) {
  auto& result = instances_[world.file];
  if (!result.empty()) return result;
  Simulation given(world, standard(), Options{plugins_, 1, {}});
  result = instance_names(given);
  given.close();
  return result;
}

// Of a parameter that an exchanged plugin has not: "; that is where physics is physics.planar (sweep.xml:2:3)".
std::string SweepRuns::where_exchanged(const std::vector<Word>& values, const std::string& path) const {
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Variation& varied = file_.varied[i];
    if (varied.kind != Variation::Kind::plugin || !path.starts_with(varied.path + '/')) continue;
    return "; that is where " + varied.path + " is " + values[i].text + " (" + values[i].place.text() +
           "): what one plugin alone has is given with it, as plugins=\"PLUGIN:NAME=VALUE\"";
  }
  return "";
}

std::unique_ptr<Simulation> SweepRuns::make(std::size_t combination, std::int64_t seed) {
  const auto values = file_.combination(combination);
  World world = world_of(values);
  world.seed = static_cast<uint64_t>(seed);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (file_.varied[i].kind == Variation::Kind::plugin)
      exchange_plugin(world, file_.varied[i], values[i], instances_of(world));
  }
  auto run = std::make_unique<Simulation>(std::move(world), standard(), Options{plugins_, workers_, {}});
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Variation& varied = file_.varied[i];
    if (varied.kind != Variation::Kind::parameter) continue;
    try {
      told_at(values[i].place, [&] {
        set_parameter(*run, {varied.path, values[i].text, varied.place, values[i].place});
      });
    } catch (const Error& error) {
      throw Error(error.exit(), error.place().file.empty() ? values[i].place : error.place(),
                  error.message() + where_exchanged(values, varied.path));
    }
  }
  return run;
}

std::vector<SweepRuns::TimedMetric> SweepRuns::metrics_of(const Simulation& run) const {
  std::vector<TimedMetric> result;
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  for (const auto& declared : file_.metrics) {
    Metric metric = metric_named(declared.of, run);
    metric.name = title_of(declared);
    result.push_back({std::move(metric), declared.over, nothing});
  }
  if (!result.empty()) return result;
  for (Metric& usual : usual_metrics(run)) result.push_back({std::move(usual), Over::end, nothing});
  if (result.empty())
    throw invalid({file_.file.string()},
                  "the world has neither robots nor messages; expected <metric of=\"TABLE/COLUMN\"/>");
  return result;
}

SweepRuns::Checked SweepRuns::check() {
  Checked result;
  std::set<std::filesystem::path> libraries;
  for (std::size_t combination = 0; combination < file_.combinations(); ++combination) {
    const auto run = make(combination, file_.seeds[0]);
    std::vector<sweep::MetricTitle> metrics;
    for (const TimedMetric& each : metrics_of(*run)) metrics.push_back({each.metric.name, each.metric.unit});
    if (combination == 0) result.metrics = metrics;
    const auto alike = [](const auto& a, const auto& b) { return a.name == b.name && a.unit == b.unit; };
    if (!std::equal(metrics.begin(), metrics.end(), result.metrics.begin(), result.metrics.end(), alike))
      throw invalid({file_.file.string()}, "the worlds differ in what can be measured; expected <metric of=\"...\"/>");
    const World& world = run->world();
    const auto [read, is_new] = result.worlds.try_emplace(world.file, world.file, plugins_);
    if (is_new) add_robots(world, read->second);
    add_files_of_instances(*run, read->second);
    for (const auto& instance : run->instances()) libraries.insert(instance->library()->file());
    for (const Occasion& occasion : run->world().occasions) {
      for (const PluginChange& change : occasion.plugins) {
        if (change.kind == PluginChange::Kind::remove) continue;
        const auto& made = change.plugin;
        libraries.insert(Library::load(made.plugin, made.library, plugins_, made.place)->file());
      }
    }
    run->close();
  }
  libraries.erase("");
  result.libraries.assign(libraries.begin(), libraries.end());
  return result;
}

std::optional<sweep::RunResult> SweepRuns::run(const sweep::Job& job) {
  sweep::RunResult result;
  std::unique_ptr<Simulation> run;
  try {
    run = make(job.combination, job.seed);
    auto metrics = metrics_of(*run);
    const Positions at_start = robot_positions(*run);
    while (!run->done()) {
      if (interrupted()) return {};
      run->step();
      for (TimedMetric& each : metrics) each.look(*run, at_start);
    }
    for (const TimedMetric& each : metrics) result.values.push_back(each.value(*run, at_start));
    result.time = run->time();
    result.digest = hexadecimal(run->digest());
    run->close();
  } catch (const Error& e) {
    if (e.exit() == Exit::io || e.exit() == Exit::internal) throw;
    result = {run ? run->time() : 0, "", e.what(), {}};
  }
  return result;
}

}  // namespace muster::cli
