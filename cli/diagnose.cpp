// muster diagnose WORLD --data FILE: what the world gets wrong, the cause, an extended world, and what that gains.
#include <fmt/core.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "diagnosis/pipeline/closed_loop.hpp"
#include "diagnosis/pipeline/diagnose.hpp"
#include "diagnosis/report/folder.hpp"
#include "diagnosis/report/json.hpp"
#include "diagnosis/report/regression.hpp"
#include "diagnosis/report/text.hpp"
#include "verbs.hpp"
#include "written_files.hpp"

namespace muster::cli {
namespace {

struct DiagnoseWords {
  std::string world, data, second, out, check;
  std::vector<std::string> plugins;
  bool json = false;
};

Error wrong(const std::string& what) {
  return {Exit::invalid_input, "muster diagnose: " + what + "; see muster diagnose --help"};
}

// The extended world takes the name of the world: it would replace another one.
void refuse_other_world(const DiagnoseWords& words) {
  const std::filesystem::path world = words.world, out = words.out;
  std::error_code none;
  const auto name = std::filesystem::is_directory(world, none) ? "world.xml" : world.filename();
  if (words.out.empty() || !std::filesystem::exists(out / name, none) ||
      std::filesystem::exists(out / "diagnosis.json", none))
    return;
  throw Error(Exit::invalid_input, "--out: " + words.out + " has a " + name.string() +
                                       " that no diagnosis has written; expected a new folder, or that of an earlier "
                                       "diagnosis");
}

DiagnoseWords diagnose_words(const Arguments& arguments) {
  CommandLine line(
      "diagnose",
      "Finds what a world gets wrong about measured readings, and names the cause where one on the plugin path "
      "explains "
      "it.\n"
      "With --out it writes a report with pictures and the world extended by the named causes, which it simulates and\n"
      "diagnoses again, and a test of the finding that --check runs. Ctrl-C ends the search with what is known so "
      "far,\n"
      "without the second diagnosis. Exit code 1: --check fails; 130: interrupted.\n"
      "Example: muster diagnose worlds/hall --data worlds/hall/measured.csv --out build/hall_extended\n"
      "         muster diagnose --check build/hall_extended");
  DiagnoseWords words;
  line.option("world", words.world, "the world's folder or file");
  line.option("--data", words.data, "measured readings, a CSV table (docs/reference/table_format.md)");
  line.option("--out", words.out, "a folder for report.html, diagnosis.json, the extended world and its test");
  line.option("--second", words.second,
              "readings of the same truth that were not used: the extended world is held against them (needs --out)");
  line.option("--check", words.check, "a folder that --out wrote: does its world still explain the data?");
  line.option("--plugins", words.plugins, "a folder of plugins, looked in first");
  line.flag("--json", words.json, "print the result as JSON, on one line");
  line.parse(arguments);
  if (!words.check.empty()) {
    if (!(words.world + words.data + words.out + words.second).empty())
      throw wrong(
          "--check goes with --plugins and --json alone, as its folder has the world and the data; expected "
          "muster diagnose --check " +
          words.check);
    return words;
  }
  if (words.world.empty()) throw wrong("world is required");
  if (words.data.empty()) throw wrong("--data is required");
  if (!words.second.empty() && words.out.empty())
    throw wrong("--second needs --out, the folder for the extended world");
  std::error_code none;
  if (std::filesystem::equivalent(words.second, words.data, none))
    throw wrong("--second: " + words.second + " is --data itself; expected readings that were not used");
  WrittenFiles::writes_folder(words.out, "--out");
  refuse_other_world(words);
  return words;
}

int check(const DiagnoseWords& words, const Library::SearchPath& path) {
  std::vector<report::Checked> all;
  {
    Progress progress("diagnose --check");
    progress.at(0);
    all = report::check_regression(words.check, path);
  }
  bool passed = true;
  auto json = Json::array();
  for (const auto& c : all) {
    passed = passed && c.passed;
    json.push_back({{"check", c.what}, {"found", c.found}, {"expected", c.expected}, {"passed", c.passed}});
    if (!words.json) fmt::print("{:<5} {}: {}; expected {}\n", c.passed ? "ok" : "FAIL", c.what, c.found, c.expected);
  }
  if (words.json) fmt::print("{}\n", Json{{"passed", passed}, {"checks", json}}.dump());
  return static_cast<int>(passed ? Exit::done : Exit::check_failed);
}

// Columns of readings come and go by the thousand: given back to the system and got again, cleared, they are some 8 %
// of a diagnosis of 20,000 readings.
void keep_memory() {
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, 1 << 30);
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
#endif
}

diagnosis::Diagnosis diagnosed(const DiagnoseWords& words, const Library::SearchPath& path) {
  Progress progress("diagnose");
  const inference::Watch watch{[&](const std::string& now) { progress.at(now); }, interrupted};
  watch_interrupt();
  if (!words.second.empty())
    diagnosis::read_dataset(words.second);  // what is wrong with them is told before the search
  diagnosis::Diagnosis found =
      diagnosis::diagnose(words.world, words.data, path, std::make_shared<TableCache>(), watch);
  if (words.out.empty() || !found.named() || found.interrupted) return found;
  watch.at("diagnosing the extended world");
  found.loop = diagnosis::closed_loop(found, words.world, words.data, words.out, path, watch);
  if (!found.loop) found.notes.emplace_back("interrupted: the extended world is written and was not diagnosed again");
  if (words.second.empty() || !found.loop) return found;
  watch.at("checking the readings of --second");
  const std::filesystem::path world(words.world);
  const auto name = std::filesystem::is_directory(world) ? "world.xml" : world.filename();
  found.loop->second = diagnosis::second_look(words.world, words.out / name, words.second, path, watch);
  if (!found.loop->second) found.notes.emplace_back("interrupted: nothing is held against the readings of --second");
  return found;
}

}  // namespace

int run_diagnose(const Arguments& arguments) {
  const DiagnoseWords words = diagnose_words(arguments);
  const Library::SearchPath path = plugin_path(words.plugins);
  keep_memory();
  if (!words.check.empty()) return check(words, path);
  const diagnosis::Diagnosis found = diagnosed(words, path);
  report::Setting setting{words.world, words.data, {}};
  if (!words.out.empty()) {
    setting.files = report::write_report(found, setting, words.out);
    for (auto& file : report::write_regression(found, words.world, words.data, words.out))
      setting.files.push_back(std::move(file));
  }
  if (words.json)
    fmt::print("{}\n", report::json_of(found).dump());
  else
    fmt::print("{}", report::text_of(found, setting));
  if (!words.second.empty() && !found.named())
    fmt::print(stderr, "muster: note: nothing is held against --second: no cause is named, so no world is extended\n");
  return static_cast<int>(interrupted() ? Exit::interrupted : Exit::done);
}

}  // namespace muster::cli
