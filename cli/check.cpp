// muster check WORLD: everything that a run does before its first tick, and what it warns of.
#include <fmt/core.h>

#include "kernel/record.hpp"
#include "text/json.hpp"
#include "verbs.hpp"

namespace muster::cli {

int run_check(const Arguments& arguments) {
  CommandLine line(
      "check",
      "Reads a world, loads and links its plugins, and says what is wrong.\nExample: muster check worlds/connectivity");
  std::string path;
  std::vector<std::string> plugins;
  bool json = false;
  line.option("world", path, "the world's folder or file").required();
  line.option("--plugins", plugins, "a folder of plugins, looked in first");
  line.flag("--json", json, "print the outcome as JSON");
  line.parse(arguments);
  const Simulation run(read_world(path, standard()), standard(), {plugin_path(plugins), 1, {}});
  check_records(run);
  if (json) {
    Json out = {{"world", run.world().name}, {"instances", Json::array()}, {"warnings", Json::array()}};
    for (const auto& instance : run.instances())
      out["instances"].push_back({{"name", instance->name()}, {"plugin", instance->plugin().id}});
    for (const auto& event : run.events()) out["warnings"].push_back(event.message);
    fmt::print("{}\n", out.dump(2));
    return 0;
  }
  for (const auto& event : run.events()) fmt::print("{}\n", event.message);
  const auto warnings = run.events().size();
  fmt::print("{}: {} instances, {} tables; {}\n", run.world().name, run.instances().size(), run.board().tables().size(),
             warnings == 0   ? "nothing is wrong"
             : warnings == 1 ? "no error, 1 warning"
                             : fmt::format("no error, {} warnings", warnings));
  return 0;
}

}  // namespace muster::cli
