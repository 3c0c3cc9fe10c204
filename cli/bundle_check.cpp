#include "bundle_check.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <optional>

#include "bundle/archive.hpp"
#include "bundle/sha256.hpp"
#include "bundle_run.hpp"
#include "run_options.hpp"
#include "text/json.hpp"
#include "text/names.hpp"
#include "text/number.hpp"
#include "text/temporary_folder.hpp"

namespace muster::cli {
namespace {

namespace fs = std::filesystem;

struct Difference {
  std::string what, there, here;
};

// The folder to which a bundle is unpacked: one that was asked for and stays, or a temporary one.
class UnpackedBundle {
 public:
  UnpackedBundle(const std::string& file, const std::string& out) {
    if (out.empty()) {
      temporary_.emplace();
      path_ = temporary_->path();
    } else {
      path_ = out;
      std::error_code failed;
      if (fs::exists(fs::symlink_status(path_)))
        throw Error(Exit::invalid_input, "--out: " + out + " is there already; expected a new folder");
      fs::create_directories(path_, failed);
      if (failed) throw Error(Exit::io, "--out: " + out + ": " + failed.message());
    }
    try {
      bundle::unpack(file, path_);
      if (!fs::is_regular_file(path_ / bundle::manifest_name))
        throw invalid({file},
                      std::string("has no ") + bundle::manifest_name + "; expected a file that `muster bundle` wrote");
      manifest_ = bundle::read_manifest(path_ / bundle::manifest_name);
    } catch (...) {
      std::error_code ignored;
      fs::remove_all(path_, ignored);
      throw;
    }
  }

  const fs::path& path() const { return path_; }
  const bundle::Manifest& manifest() const { return manifest_; }
  std::string id() const { return bundle::sha256_of(path_ / bundle::manifest_name); }

 private:
  std::optional<TemporaryFolder> temporary_;
  fs::path path_;
  bundle::Manifest manifest_;
};

std::string joined_words(const std::vector<std::string>& words) {
  std::string result;
  for (const std::string& word : words) result += (result.empty() ? "" : " ") + word;
  return result;
}

void compare(std::vector<Difference>& to, const std::string& what, const std::string& there, const std::string& here) {
  if (there != here) to.push_back({what, there, here});
}

std::vector<Difference> differences_of_machines(const bundle::Manifest& manifest) {
  const bundle::Machine &there = manifest.machine, here = bundle::this_machine();
  std::vector<Difference> result;
  compare(result, "muster", manifest.muster, MUSTER_VERSION);
  compare(result, "architecture", there.architecture, here.architecture);
  compare(result, "compiler", there.compiler, here.compiler);
  compare(result, "C library", there.libc, here.libc);
  compare(result, "system", there.system, here.system);
  compare(result, "processor", there.cpu, here.cpu);
  compare(result, "vector instructions", joined_words(there.cpu_features), joined_words(here.cpu_features));
  return result;
}

// The first of that path below the folders of plugins, a library or a model.
fs::path among_plugins(const std::string& name, const Library::SearchPath& plugins) {
  for (const fs::path& folder : plugins)
    if (fs::is_regular_file(folder / name)) return folder / name;
  return {};
}

const bundle::ListedFile& listed(const bundle::Manifest& manifest, const std::string& name) {
  return *std::find_if(manifest.files.begin(), manifest.files.end(), [&](const auto& f) { return f.name == name; });
}

std::string newest_id(const fs::path& file) try {
  return LibraryLoader({}).open(file)->plugins().back().id;
} catch (const std::exception&) {
  return "one that cannot be loaded";
}

// Revisions of plugins, models that differ, and how many plugins are other builds of the same revision.
struct PluginDifferences {
  std::vector<Difference> differences;
  std::size_t other_builds = 0;
};
PluginDifferences differences_of_plugins(const bundle::Manifest& manifest, const Library::SearchPath& plugins) {
  static const std::string below = "plugins/";
  PluginDifferences result;
  for (const bundle::ListedPlugin& plugin : manifest.plugins) {
    if (!plugin.file.starts_with(below)) continue;  // of the world's own folder
    const fs::path own = among_plugins(plugin.file.substr(below.size()), plugins);
    if (own.empty()) {
      result.differences.push_back({"plugin", plugin.id, "none"});
    } else if (bundle::sha256_of(own) != listed(manifest, plugin.file).sha256) {
      const std::string id = newest_id(own);
      compare(result.differences, "plugin", plugin.id, id);
      if (id == plugin.id) ++result.other_builds;
    }
  }
  for (const bundle::ListedFile& file : manifest.files) {
    if (!file.name.starts_with(below) || file.name.ends_with(".so")) continue;
    const std::string name = file.name.substr(below.size());
    const fs::path own = among_plugins(name, plugins);
    const std::string here = own.empty() ? "none" : bundle::sha256_of(own);
    if (here != file.sha256)
      result.differences.push_back({name, "SHA-256 " + file.sha256, own.empty() ? here : "SHA-256 " + here});
  }
  return result;
}

// Code of the bundle is run only where that was asked for.
void refuse_library(const InstanceDeclaration& instance) {
  if (instance.library)
    throw invalid(instance.place, "the library " + quote(instance.library->string()) +
                                      " is the bundle's own; expected --plugins-of-bundle, which runs its code");
}
void refuse_libraries(const World& world) {
  for (const InstanceDeclaration& instance : world.instances) refuse_library(instance);
  for (const Occasion& occasion : world.occasions)
    for (const PluginChange& change : occasion.plugins) refuse_library(change.plugin);
}

std::vector<bundle::Waymark> run_here(const UnpackedBundle& unpacked, const Library::SearchPath& plugins,
                                      const BundleCheckWords& words) {
  const bundle::Manifest& manifest = unpacked.manifest();
  World world = read_world(unpacked.path() / manifest.world, standard());
  if (words.own_plugins) refuse_libraries(world);
  world.ticks = manifest.ticks;
  world.seed = manifest.seed;
  Simulation run(std::move(world), standard(), {plugins, words.workers, {}});
  set_parameters(run, manifest.set);
  std::vector<bundle::Waymark> result = waymarks_of(run, "muster bundle check " + words.file);
  run.close();
  return result;
}

// Where two runs part: the first digest that differs, and the tables that do then.
struct Parting {
  std::uint64_t tick = 0;
  std::optional<std::uint64_t> same_until;  // the last tick seen at which all was the same
  std::vector<std::string> tables;
};
std::optional<Parting> parting_of(const std::vector<bundle::Waymark>& there, const std::vector<bundle::Waymark>& here) {
  std::optional<std::uint64_t> same;
  for (const bundle::Waymark& mark : there) {
    const auto own = std::find_if(here.begin(), here.end(), [&](const auto& m) { return m.tick == mark.tick; });
    if (own == here.end()) continue;
    if (own->digest == mark.digest) {
      same = mark.tick;
      continue;
    }
    Parting result{mark.tick, same, {}};
    for (const auto& [name, digest] : mark.tables) {
      const auto found = own->tables.find(name);
      if (found == own->tables.end() || found->second != digest) result.tables.push_back(name);
    }
    for (const auto& [name, digest] : own->tables)
      if (!mark.tables.count(name)) result.tables.push_back(name);
    return result;
  }
  return {};
}

Json json_of(const std::vector<Difference>& differences) {
  Json result = Json::array();
  for (const Difference& one : differences)
    result.push_back({{"what", one.what}, {"there", one.there}, {"here", one.here}});
  return result;
}

void print_faults(const bundle::Faults& faults) {
  for (const std::string& name : faults.changed) fmt::print("  changed: {}\n", name);
  for (const std::string& name : faults.missing) fmt::print("  missing: {}\n", name);
  for (const std::string& name : faults.extra) fmt::print("  not listed: {}\n", name);
}

void print_parting(const Parting& parting, double dt) {
  constexpr std::size_t most_tables = 8;
  const auto seconds = [&](std::uint64_t tick) { return print_real(static_cast<double>(tick) * dt); };
  if (parting.same_until)
    fmt::print("  the same after tick {} ({} s), different after tick {} ({} s), in\n", *parting.same_until,
               seconds(*parting.same_until), parting.tick, seconds(parting.tick));
  else
    fmt::print("  different from the start, in\n");
  for (std::size_t i = 0; i < std::min(parting.tables.size(), most_tables); ++i)
    fmt::print("    {}\n", parting.tables[i]);
  if (parting.tables.size() > most_tables) fmt::print("    and {} more\n", parting.tables.size() - most_tables);
  if (parting.tables.empty()) fmt::print("    rows that joined or left\n");
}

}  // namespace

Exit check_bundle(const BundleCheckWords& words) {
  watch_interrupt();  // from here on, so that what is unpacked is taken away
  const UnpackedBundle unpacked(words.file, words.out);
  const bundle::Manifest& manifest = unpacked.manifest();
  const bundle::Faults faults = bundle::faults_of(unpacked.path(), manifest);
  Library::SearchPath plugins;
  if (words.own_plugins)
    plugins = plugin_path(words.plugins);
  else
    plugins.push_back(unpacked.path() / "plugins");

  std::vector<Difference> differences = differences_of_machines(manifest);
  PluginDifferences own;
  if (words.own_plugins) own = differences_of_plugins(manifest, plugins);
  differences.insert(differences.end(), own.differences.begin(), own.differences.end());
  if (!words.json) {
    fmt::print("{}: {} files, made {} by muster {}, list {}\n", words.file, manifest.files.size(), manifest.date,
               manifest.muster, unpacked.id());
    print_faults(faults);
    for (const Difference& one : differences)
      fmt::print("  differs: {}: {} there, {} here\n", one.what, one.there, one.here);
    if (own.other_builds > 0)
      fmt::print("  {} of {} plugins are other builds of the same revision\n", own.other_builds,
                 manifest.plugins.size());
  }

  std::vector<bundle::Waymark> here;
  std::optional<Parting> parting;
  if (!faults.any()) {
    std::fflush(stdout);  // what differs may be why the run below is refused
    here = run_here(unpacked, plugins, words);
    parting = parting_of(manifest.waymarks, here);
  }
  const std::string& expected = manifest.waymarks.back().digest;
  const bool is_same = !faults.any() && !parting && here.back().digest == expected;
  if (words.json) {
    Json json{{"bundle", words.file},
              {"list", unpacked.id()},
              {"changed", faults.changed},
              {"missing", faults.missing},
              {"not_listed", faults.extra},
              {"differences", json_of(differences)},
              {"other_builds", own.other_builds},
              {"ticks", manifest.ticks},
              {"seed", manifest.seed},
              {"expected", expected},
              {"digest", here.empty() ? Json() : Json(here.back().digest)},
              {"same", is_same}};
    if (parting) {
      json["first_difference"] = {{"tick", parting->tick},
                                  {"same_until", parting->same_until ? Json(*parting->same_until) : Json()},
                                  {"tables", parting->tables}};
    }
    fmt::print("{}\n", json.dump(2));
  } else if (faults.any()) {
    fmt::print("the files are not those of the bundle that was made; it was not run\n");
  } else if (is_same) {
    fmt::print("the same digest after {} ticks: {}\n", manifest.ticks, expected);
  } else {
    fmt::print("another digest after {} ticks: {} there, {} here\n", manifest.ticks, expected, here.back().digest);
    if (parting) print_parting(*parting, manifest.dt);
  }
  return is_same ? Exit::done : Exit::check_failed;
}

}  // namespace muster::cli
