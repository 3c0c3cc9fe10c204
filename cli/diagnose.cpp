// muster diagnose WORLD --data FILE: what the world gets wrong, the cause, an extended world, and what that gains.
#include <fmt/core.h>

#include "diagnosis/report/folder.hpp"
#include "diagnosis/report/json.hpp"
#include "diagnosis/report/text.hpp"
#include "verbs.hpp"

namespace muster::cli {

int run_diagnose(const Arguments& arguments) {
  CLI::App app(
      "Finds what a world gets wrong about measured readings and names the cause where one of the plugin path explains "
      "it.\nWith --out, writes the world extended by the named causes, simulates it and diagnoses it again.\n"
      "Example: muster diagnose worlds/hall --data worlds/hall/measured.csv --out build/hall_extended",
      "diagnose");
  std::string world, data, out;
  std::vector<std::string> plugins;
  bool json = false;
  app.add_option("world", world, "the world's folder or file")->required();
  app.add_option("--data", data, "measured readings, a CSV table (docs/table_format.md)")->required();
  app.add_option("--out", out, "a folder for the extended world");
  app.add_option("--plugins", plugins, "a folder of plugins, looked in first");
  app.add_flag("--json", json, "print the result as JSON");
  parse(app, arguments);
  const Library::SearchPath path = plugin_path(plugins);
  diagnosis::Diagnosis found;
  {
    Progress progress("diagnose");
    progress.at(0);
    found = diagnosis::diagnose(world, data, path);
    progress.at(0.5);
    if (!out.empty() && found.named()) found.loop = diagnosis::closed_loop(found, world, data, out, path);
    progress.at(1);
  }
  report::Setting setting{world, data, {}};
  if (!out.empty()) setting.files = report::write_report(found, setting, out);
  if (json)
    fmt::print("{}\n", report::json_of(found).dump());
  else
    fmt::print("{}", report::text_of(found, setting));
  return static_cast<int>(Exit::done);
}

}  // namespace muster::cli
