// muster run WORLD and muster swap WORLD: the same run, with or without an exchange on the way.
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <optional>

#include "all_parts.hpp"
#include "idle_doubts.hpp"
#include "isolated_instances.hpp"
#include "level_terms.hpp"
#include "live_view.hpp"
#include "pacing.hpp"
#include "plugin_watcher.hpp"
#include "restored_run.hpp"
#include "run_costs.hpp"
#include "run_log_files.hpp"
#include "run_options.hpp"
#include "run_pictures.hpp"
#include "run_record.hpp"
#include "saved_run.hpp"
#include "snapshot_loss.hpp"
#include "text/json.hpp"
#include "text/names.hpp"
#include "text/number.hpp"
#include "text/temporary_folder.hpp"
#include "way_doubts.hpp"
#include "world_file/kinds.hpp"
#include "written_files.hpp"

namespace muster::cli {
namespace {

struct RunWords : RunOptions {
  std::string world, save, restore;
  uint64_t digest_every = 0;
  bool watch = false, expected = false, real_time = false, cost = false;
  std::optional<std::string> speed, save_every, isolate_limit;
  std::vector<std::string> isolate;
  bool view = false;
  ViewSettings view_at;
  PluginChange swap;  // of the verb swap
  std::string swap_at;
  LogWords log;
};

void declare(CommandLine& line, RunWords& words) {
  line.option("world", words.world, "the world's folder or file").required();
  declare(line, static_cast<RunOptions&>(words));
  declare(line, words.log);
  line.option("--save", words.save,
              "write the state at the end to this file, and see that it holds all: as long again, 10 s at most");
  line.option("--save-every", words.save_every,
              "with --save: also on the way, each time so many seconds of the run have passed");
  line.option("--restore", words.restore,
              "begin from a state that --save wrote; a --seed beside it counts from there on");
  line.option("--digest-every", words.digest_every, "print the digest every so many ticks").at_least(1);
  line.option(
          "--isolate", words.isolate,
          "INSTANCE, INSTANCE=stop, =restart or =without: it steps in a process of its own, and where that ends, the "
          "run stops, the step is taken again, or the run goes on without it; \"all\": every instance")
      .one_word_each();
  line.option("--isolate-limit", words.isolate_limit,
              "with --isolate: seconds after which a step that has not returned is ended; 30 if not given");
  line.only_with("--isolate-limit", "--isolate");
  line.flag("--cost", words.cost, "print the CPU time of each plugin, and of a link in those of the radio");
  line.flag("--watch", words.watch, "load a plugin again when its file changes on disk");
  line.flag("--real-time", words.real_time, "at the pace of the clock: a second of the run takes a second");
  line.option("--speed", words.speed, "with --real-time: so many seconds of the run a second");
  line.flag("--view", words.view, "serve the page of the run as it goes, at the pace of the clock");
  line.option("--port", words.view_at.port, "with --view: its port; by default one that is free").within(0, 65535);
  line.option("--address", words.view_at.address, "with --view: another address than 127.0.0.1; needs --token");
  line.option("--token", words.view_at.token, "with --view: a word without which the page is not given");
  line.flag("--paused", words.view_at.is_paused, "with --view: the run begins paused");
  line.option("--origin", words.view_at.origins,
              "with --view: a site whose page may watch, such as https://app.foxglove.dev")
      .one_word_each();
  line.only_with("--save-every", "--save");
  for (const char* option : {"--port", "--address", "--token", "--paused", "--origin"})
    line.only_with(option, "--view");
  line.flag("--expected", words.expected, "run no tick: evaluate the radio channel once, as it is expected on average");
  line.void_beside("--expected", {"--until", "--digest-every", "--save-every", "--watch", "--real-time", "--speed"},
                   "runs no tick");
}

// The tables of OBSERVE instances: what the world's authors chose to see of it.
Json observed(const Simulation& run) {
  Json result = Json::object();
  for (const auto& instance : run.instances()) {
    if (instance->phase() != MUSTER_OBSERVE) continue;
    for (const auto& claim : instance->claims()) {
      if (!claim.out || claim.out->set().name != "instance/" + instance->name()) continue;
      const Table& table = *claim.out;
      for (std::size_t c = 0; c < table.width(); ++c) {
        result[instance->name()][claim.name.quantity][table.columns()[c].title()] = table.now().data[c];
      }
    }
  }
  return result;
}

using Digests = std::vector<std::pair<uint64_t, uint64_t>>;  // tick, digest

// What is the same each time.
Json outcome_of(const Simulation& run) {
  Json json = {{"world", run.world().name}, {"seed", run.world().seed}, {"dt", run.world().dt},
               {"ticks", run.tick()},       {"time", run.time()},       {"digest", hexadecimal(run.digest())},
               {"observed", observed(run)}};
  json["events"] = Json::array();
  for (const auto& event : run.events())
    json["events"].push_back({{"time", static_cast<double>(event.tick) * run.world().dt},
                              {"instance", event.instance},
                              {"message", event.message}});
  return json;
}

// What is told before the first tick and is no note is a warning, as muster check says.
std::string with_kind(const Event& event) {
  const bool has_kind = event.message.starts_with("note: ") || event.message.starts_with("warning: ");
  return (event.tick > 0 || has_kind ? "" : "warning: ") + event.message;
}

// `pace`: simulated time over time that passed; not in the JSON, which is the same each time.
void print_outcome(const Simulation& run, const RunWords& words, const Digests& digests,
                   const std::vector<std::filesystem::path>& files, double pace) {
  Json json = outcome_of(run);
  if (words.digest_every) json["digests"] = Json::array();
  for (const auto& [tick, digest] : digests)
    json["digests"].push_back({{"tick", tick}, {"digest", hexadecimal(digest)}});
  json["files"] = Json::array();
  for (const auto& file : files) json["files"].push_back(file.string());
  if (words.cost) json["cost"] = json_of(costs_of(run));
  if (words.json) {
    fmt::print("{}\n", json.dump(2));
    return;
  }
  fmt::print("{}: {} ticks, {} s, digest {}\n", run.world().name, run.tick(), print_real(run.time()),
             hexadecimal(run.digest()));
  if (pace > 0) fmt::print("  {:.{}f} times real time\n", pace, pace < 10 ? 1 : 0);
  for (const auto& event : run.events())
    fmt::print("  t = {:.9g} s  {}{}{}\n", static_cast<double>(event.tick) * run.world().dt, event.instance,
               event.instance.empty() ? "" : ": ", with_kind(event));
  for (const auto& [instance, tables] : json["observed"].members()) {
    for (const auto& [table, cells] : tables.members()) {
      for (const auto& [column, value] : cells.members())
        fmt::print("  {}/{} {} = {}\n", instance, table, column, value.is_null() ? "" : print_real(value.real()));
    }
  }
  if (words.cost) print(costs_of(run));
  for (const auto& file : files) fmt::print("  wrote {}\n", file.string());
}

void add_page(const RunRecord& record, const RunWords& words, std::vector<std::filesystem::path>& files) {
  std::string why_not;
  if (auto page = record.write_page(why_not); !page.empty()) files.push_back(std::move(page));
  if (!why_not.empty() && !words.json) fmt::print(stderr, "muster: note: no run.html: {}\n", why_not);
}

// Times real time; none without --real-time.
std::optional<double> speed_of(const RunWords& words) {
  if (!words.speed) return words.real_time || words.view ? std::optional(1.0) : std::nullopt;
  constexpr double least = 1e-3, most = 1e6;
  const double speed = real_of(*words.speed, "--speed");
  if (!(speed >= least && speed <= most))
    throw Error(Exit::invalid_input, "--speed: " + *words.speed + " is out of bounds; expected a number from " +
                                         print_real(least) + " to " + print_real(most) + ", times real time" +
                                         (speed == 0 ? "; a run without --real-time goes as fast as it can" : ""));
  if (!words.real_time && !words.view)
    throw Error(Exit::invalid_input, "--speed needs --real-time or --view beside it");
  return speed;
}

void check_written(const RunWords& words) {
  WrittenFiles files;
  files.reads_world(words.world);
  if (words.restore != words.save)
    files.reads(words.restore, "--restore");  // a state that goes on may stay in one file
  WrittenFiles::writes_folder(words.out, "--out",
                              std::filesystem::path(words.out).extension() == ".mcap" ? "--mcap" : "--wide");
  if (!words.restore.empty() && !words.out.empty()) WrittenFiles::replaces_no_record(words.out, "--out");
  files.writes(words.log.mcap, "--mcap");
  files.writes(words.log.wide, "--wide");
  files.writes(words.save, "--save");
}

// Throws Error.
World asked_world(RunWords& words) {
  check_written(words);
  words.may_log = true;
  words.has_log = !words.log.mcap.empty() || !words.log.wide.empty();
  check(words.view_at);
  if (words.view && words.expected)
    throw Error(Exit::invalid_input, "--view shows a run, and --expected runs no tick; expected one of them");
  if (!words.log.plot.empty() && words.expected)
    throw Error(Exit::invalid_input, "--plot shows a run, and --expected runs no tick; expected one of them");
  World world = world_of(words.world, words);
  add_plotted(words.log, words.out, world.records);
  if (!words.swap.instance.empty()) {
    const PluginChange& swap = words.swap;
    const uint64_t tick = ticks_of(real_of(words.swap_at, "--at", "s"), world.dt, {"--at"});
    if (tick >= world.ticks)
      throw Error(Exit::invalid_input, "--at: " + words.swap_at +
                                           " s is at the end of the run or after it; expected less than " +
                                           print_real(world.until()) + " s");
    const auto known = std::any_of(world.instances.begin(), world.instances.end(),
                                   [&](const auto& i) { return i.name == swap.instance; });
    if (!known) {
      std::vector<std::string> names;
      for (const auto& instance : world.instances) names.push_back(instance.name);
      throw Error(Exit::invalid_input, "--instance: no instance is called " + quote(swap.instance) +
                                           which_is(world, swap.instance, "instance") + "; " +
                                           suggest(swap.instance, names) +
                                           plugin_hint(swap.instance, whose_plugin(world.instances, swap.instance)));
    }
    world.occasions.push_back({.tick = tick, .plugins = {swap}});
  }
  return world;
}

constexpr double longest_proof = 10;  // that a saved state holds all [s] of the clock

// The run from its start to its end, and how it ended; none where a client wants it anew.
std::optional<Exit> run_once(const RunWords& words, const World& world, std::optional<double> speed, LiveView* view) {
  const auto& records = world.records;
  const SavedRun saved(words.save, words.save_every, world.dt);
  Options options{plugin_path(words.plugins), words.workers, {}};
  options.costs = words.cost;
  options.isolated = isolations_of(words.isolate, words.isolate_limit);
  const Isolations isolated = options.isolated;
  Simulation run(world, standard(), std::move(options));
  check_records(run);
  for (const auto& doubts : {level_doubts(run), idle_doubts(run), way_doubts(run)})
    for (const std::string& doubt : doubts) fmt::print(stderr, "muster: warning: {}\n", doubt);
  for (const std::string& one : idle_notes(run)) fmt::print(stderr, "muster: note: {}\n", one);
  if (!words.restore.empty()) restore(run, words.restore, words.seed.has_value());
  set_parameters(run, words.set);
  if (!words.restore.empty()) {
    check_end(run, words.restore, words.expected);
    if (!words.swap.instance.empty()) check_swap(run, words.restore, world.occasions.back());
  }
  if (!words.log.wide.empty() && records.empty())
    throw Error(Exit::invalid_input,
                "--wide: the world records no table; expected <record table=\"robot/*/pose\"/>, or --record");
  std::optional<RunRecord> record;
  std::optional<RunPictures> pictures;
  std::optional<RunLogFiles> log;
  std::optional<TemporaryFolder> unnamed;  // of a record that is only watched
  if (words.out.empty() && words.view) unnamed.emplace();
  if (!words.out.empty() || unnamed) {
    record.emplace(run, records, unnamed ? unnamed->path().string() : words.out, plugin_path(words.plugins));
    pictures.emplace(run);
    if (!words.expected) record->write(run);
    pictures->look(run);
  } else if (!records.empty() && !words.has_log && !words.json) {
    fmt::print(stderr, "muster: note: the world records tables; --out DIR says where to\n");
  }
  if (words.log.any()) {
    log.emplace(run, records, words.log, words.out);
    if (!words.expected) log->write(run);
  }
  PluginWatcher watcher;
  Digests digests;
  Progress progress("muster run " + run.world().name);
  SteadyClock clock(interrupted);
  std::optional<Pacing> pacing;
  if (view) {
    view->watch(run, [&] { return record->so_far(run, outcome_of(run)); });
    view->wait_for_reader();
  }
  if (speed && !words.expected) pacing.emplace(view ? static_cast<WallClock&>(*view) : clock, *speed, run.time());
  const double began_at = run.time();
  const auto began = std::chrono::steady_clock::now();
  // Each of them is written even where another cannot be.
  const auto finish = [&] {
    std::vector<std::filesystem::path> files;
    AllParts parts;
    parts.run([&] {
      if (!record) return;
      auto written = record->close(run, outcome_of(run));
      if (!unnamed) files = std::move(written);
    });
    parts.run([&] {
      if (!log) return;
      for (auto& file : log->close(run)) files.push_back(std::move(file));
      for (const auto& note : log->notes()) fmt::print(stderr, "muster: note: {}\n", note);
    });
    parts.run([&] {
      if (saved.at_end(run)) files.emplace_back(words.save);
    });
    parts.throw_first();
    return files;
  };
  try {
    if (words.expected) {
      run.evaluate(MUSTER_RADIO, true);
      if (record) record->write(run);
      if (log) log->write(run);
    }
    while (!words.expected && !run.done() && !interrupted()) {
      if (words.watch) watcher.look(run);
      if (view && !view->is_due(*pacing)) break;
      run.step();
      if (record) record->write(run), pictures->look(run);
      if (log) log->write(run);
      if (words.digest_every && run.tick() % words.digest_every == 0) {
        digests.emplace_back(run.tick(), run.digest());
        if (!words.json) fmt::print("{} {}\n", run.tick(), hexadecimal(digests.back().second));
      }
      saved.after_tick(run);
      if (view) view->after_tick();
      if (pacing) pacing->wait(run.time());
      const double share = static_cast<double>(run.tick()) / static_cast<double>(run.world().ticks);
      progress.at(share);
      if (!pacing) progress.tell_if_endless(share);
    }
  } catch (const Error& first) {
    try {
      finish();  // what stands up to the last whole tick is kept
    } catch (const Error& also) {
      if (std::string_view(also.what()) != first.what()) fmt::print(stderr, "muster: error: {}\n", also.what());
    }
    throw;
  }
  if (view && view->wants_anew()) return {};
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
  auto files = finish();
  if (const auto late = pacing ? pacing->warning(run.world().dt) : ""; !late.empty())
    fmt::print(stderr, "muster: warning: {}\n", late);
  if (view) view->finish();
  if (view && view->wants_anew()) return {};
  if (pictures && !unnamed) {
    for (auto& file : pictures->write(words.out)) files.push_back(std::move(file));
  }
  if (record && !unnamed) add_page(*record, words, files);
  const Exit ended = interrupted() ? Exit::interrupted : Exit::done;  // the proof below is no part of the run
  print_outcome(run, words, digests, files, (run.time() - began_at) / took.count());
  if (!words.save.empty() && !view && !words.watch && !words.expected && ended == Exit::done) {
    std::fflush(stdout);
    Options proof{plugin_path(words.plugins), words.workers, {}};
    proof.isolated = isolated;
    const std::string lost =
        loss_of_snapshot(run, world, std::move(proof), std::clamp(took.count(), 1.0, longest_proof));
    if (!lost.empty()) fmt::print(stderr, "muster: warning: --save: {} {}\n", words.save, lost);
  }
  run.close();
  return ended;
}

int run_world(RunWords& words) {
  const auto speed = speed_of(words);
  const World world = asked_world(words);
  watch_interrupt();
  std::optional<LiveView> view;
  if (words.view) view.emplace(words.view_at, world.records, *speed);
  std::optional<Exit> ended;
  while (!ended) ended = run_once(words, world, speed, view ? &*view : nullptr);
  return static_cast<int>(*ended);
}

}  // namespace

int run_run(const Arguments& arguments) {
  CommandLine line("run", "Runs a world.\nExample: muster run worlds/connectivity --out out/connectivity");
  RunWords words;
  declare(line, words);
  line.parse(arguments);
  return run_world(words);
}

int run_swap(const Arguments& arguments) {
  CommandLine line(
      "swap",
      "Runs a world and exchanges the plugin of an instance on the way, state carried over.\n"
      "Example: muster swap worlds/hot_swap --at 5 --instance physics --plugin physics.planar acceleration=4");
  RunWords words;
  std::vector<std::string> attributes;
  declare(line, words);
  line.option("--at", words.swap_at, "when, in seconds of the run, such as 5").required();
  line.option("--instance", words.swap.instance, "the instance, by its name in the world, such as physics").required();
  line.option("--plugin", words.swap.plugin.plugin, "its new plugin, such as physics.planar").required();
  line.option("attributes", attributes, "NAME=VALUE: attributes of the new plugin");
  line.parse(arguments);
  if (words.expected)
    throw Error(Exit::invalid_input,
                "muster swap: --expected runs no tick, so that nothing is exchanged; expected muster run WORLD "
                "--expected, or no --expected");
  auto& replacement = words.swap.plugin;
  replacement = instance_of(words.swap.instance, replacement.plugin, attributes, "muster swap");
  return run_world(words);
}

}  // namespace muster::cli
