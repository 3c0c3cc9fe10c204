// muster check WORLD: everything that a run does up to its first tick, that tick included, and what it warns of.
#include <fmt/core.h>

#include <cstdlib>

#include "idle_doubts.hpp"
#include "kernel/record.hpp"
#include "level_terms.hpp"
#include "text/json.hpp"
#include "verbs.hpp"
#include "way_doubts.hpp"

namespace muster::cli {
namespace {

const std::string note = "note: ";

// What is to be known of a world in which nothing is wrong.
std::vector<std::string> notes_of(const Simulation& run) {
  std::vector<std::string> result;
  for (const auto& event : run.events()) {
    if (event.message.starts_with(note)) result.push_back(event.message);
  }
  for (const std::string& one : idle_notes(run)) result.push_back(note + one);
  return result;
}

// All that is reported before the first tick, and warnings in it: other events of a tick are no fault of the world.
std::vector<std::string> warnings_of(const Simulation& run) {
  static const std::string prefix = "warning: ";
  std::vector<std::string> result;
  for (const auto& event : run.events()) {
    if (event.message.starts_with(note)) continue;
    const bool is_warning = event.message.starts_with(prefix);
    if (is_warning || event.tick == 0) result.push_back(is_warning ? event.message : prefix + event.message);
  }
  for (const auto& doubts : {level_doubts(run), idle_doubts(run), way_doubts(run)})
    for (const std::string& doubt : doubts) result.push_back(prefix + doubt);
  return result;
}

}  // namespace

int run_check(const Arguments& arguments) {
  CommandLine line("check",
                   "Reads a world, loads and links its plugins, runs its first tick, and says what is wrong.\n"
                   "Example: muster check worlds/connectivity");
  std::string path;
  std::vector<std::string> plugins;
  bool json = false;
  line.option("world", path, "the world's folder or file").required();
  line.option("--plugins", plugins, "a folder of plugins, looked in first");
  line.flag("--json", json, "print the outcome as JSON");
  line.parse(arguments);
  ::setenv("MUSTER_BRIDGE", "off", 1);  // nobody need be there to drive the one tick (plugins/bridge_socket)
  Simulation run(read_world(path, standard()), standard(), {plugin_path(plugins), 1, {}});
  check_records(run);
  if (!run.done()) run.step();
  const auto warnings = warnings_of(run), notes = notes_of(run);
  if (json) {
    Json out = {{"world", run.world().name},
                {"instances", Json::array()},
                {"warnings", Json::array()},
                {"notes", Json::array()}};
    for (const auto& instance : run.instances())
      out["instances"].push_back({{"name", instance->name()}, {"plugin", instance->plugin().id}});
    for (const auto& warning : warnings) out["warnings"].push_back(warning);
    for (const auto& one : notes) out["notes"].push_back(one);
    fmt::print("{}\n", out.dump(2));
    return 0;
  }
  for (const auto& warning : warnings) fmt::print("{}\n", warning);
  for (const auto& one : notes) fmt::print("{}\n", one);
  fmt::print("{}: {} instances, {} tables; {}\n", run.world().name, run.instances().size(), run.board().tables().size(),
             warnings.empty()       ? "nothing is wrong"
             : warnings.size() == 1 ? "no error, 1 warning"
                                    : fmt::format("no error, {} warnings", warnings.size()));
  run.close();
  return 0;
}

}  // namespace muster::cli
