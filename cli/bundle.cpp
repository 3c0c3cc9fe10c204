// muster bundle WORLD and muster bundle check FILE: a run with all that it needs in one file, and whether another
// machine comes to the same digest.
#include <fmt/core.h>

#include <ctime>
#include <fstream>
#include <set>

#include "bundle/archive.hpp"
#include "bundle/sha256.hpp"
#include "bundle/world_files.hpp"
#include "bundle_check.hpp"
#include "bundle_run.hpp"
#include "run_options.hpp"
#include "text/file_kind.hpp"
#include "text/json.hpp"
#include "text/names.hpp"
#include "text/temporary_folder.hpp"
#include "verbs.hpp"

namespace muster::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char archive_ending[] = ".tar.zst";

struct BundleWords : RunOptions {
  std::vector<std::string> subject;  // WORLD, or "check" FILE
  std::vector<std::string> data;
  bool plugins_of_bundle = false;
};

std::string date_of_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  ::gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

// Plugins and the files that they read where the world does not say which.
class BundledPlugins {
 public:
  explicit BundledPlugins(bundle::WorldFiles& files) : files_(files) {}

  void add(const Library& library, const muster_plugin& plugin, const InstanceDeclaration& declared) {
    if (library.file().empty()) return;  // of the program itself
    if (!files_.has(library.file())) files_.add_plugin(library.file());
    libraries_[plugin.id] = fs::absolute(library.file()).lexically_normal();
    add_default_files(plugin, declared, files_);
  }
  void add(const Simulation& run, const Library::SearchPath& plugins) {
    for (const auto& instance : run.instances()) add(*instance->library(), instance->plugin(), instance->declared());
    for (const Occasion& occasion : run.world().occasions) {
      for (const PluginChange& change : occasion.plugins) {
        if (change.kind == PluginChange::Kind::remove) continue;
        const InstanceDeclaration& made = change.plugin;
        const auto library = Library::load(made.plugin, made.library, plugins, made.place);
        add(*library, library->plugins().back(), made);
      }
    }
  }
  std::vector<bundle::ListedPlugin> listed() const {
    std::vector<bundle::ListedPlugin> result;
    for (const auto& [id, file] : libraries_)
      for (const auto& [name, bundled] : files_.files())
        if (bundled.source == file) {
          result.push_back({id, name});
          break;
        }
    return result;
  }

 private:
  bundle::WorldFiles& files_;
  std::map<std::string, fs::path> libraries_;  // by the plugin's id
};

// The files in a folder as they are to be in the bundle, with their hashes.
std::vector<bundle::ListedFile> gather(const bundle::WorldFiles& files, const fs::path& folder) {
  std::vector<bundle::ListedFile> result;
  for (const auto& [name, file] : files.files()) {
    const fs::path to = folder / name;
    fs::create_directories(to.parent_path());
    if (file.text) {
      std::ofstream out(to, std::ios::binary);
      out << *file.text;
      if (!out.flush()) throw Error(Exit::io, to.string() + ": cannot be written");
    } else {
      fs::copy_file(file.source, to);
    }
    result.push_back({name, fs::file_size(to), bundle::sha256_of(to), file.named});
  }
  return result;
}

std::vector<bundle::Waymark> run_of(World world, const Library::SearchPath& plugins, const BundleWords& words,
                                    const std::string& title) {
  Simulation run(std::move(world), standard(), {plugins, words.workers, {}});
  set_parameters(run, words.set);
  std::vector<bundle::Waymark> result = waymarks_of(run, title);
  run.close();
  return result;
}

// The run out of the bundle alone, which shows that nothing is lacking in it.
void expect_same(const bundle::Manifest& manifest, const fs::path& folder, const BundleWords& words) {
  World world = read_world(folder / manifest.world, standard());
  world.ticks = manifest.ticks;
  world.seed = manifest.seed;
  std::vector<bundle::Waymark> again;
  try {
    again = run_of(std::move(world), {folder / "plugins"}, words, "muster bundle: out of the bundle");
  } catch (const Error& e) {
    if (e.exit() == Exit::interrupted) throw;
    throw Error(e.exit(), std::string("the world does not run out of its bundle: ") + e.what() +
                              "; expected --data FILE for what no XML file names");
  }
  if (again.back().digest != manifest.waymarks.back().digest)
    throw Error(Exit::check_failed, "the world comes to digest " + manifest.waymarks.back().digest +
                                        " where it lies, and to " + again.back().digest +
                                        " out of its bundle; expected --data FILE for what no XML file names");
}

Exit make_bundle(const BundleWords& words) {
  const std::string& given = words.subject[0];
  const World world = world_of(given, words);
  const Library::SearchPath plugins = plugin_path(words.plugins);
  bundle::WorldFiles files(world.file, plugins);
  add_robots(world, files);
  for (const std::string& file : words.data) files.add_data(file);

  watch_interrupt();
  BundledPlugins libraries(files);
  bundle::Manifest manifest;
  {
    Simulation run(world, standard(), {plugins, words.workers, {}});
    set_parameters(run, words.set);
    libraries.add(run, plugins);
    manifest.waymarks = waymarks_of(run, "muster bundle " + world.name);
    libraries.add(run, plugins);  // and those that joined on the way
    run.close();
  }
  manifest.date = date_of_now();
  manifest.muster = MUSTER_VERSION;
  manifest.machine = bundle::this_machine();
  manifest.world = files.world();
  manifest.seed = world.seed, manifest.ticks = world.ticks, manifest.dt = world.dt;
  manifest.set = words.set;
  manifest.plugins = libraries.listed();

  const TemporaryFolder folder;
  fs::create_directory(folder.path() / "plugins");
  manifest.files = gather(files, folder.path());
  expect_same(manifest, folder.path(), words);
  std::vector<std::string> names{bundle::manifest_name};
  for (const bundle::ListedFile& file : manifest.files) names.push_back(file.name);
  std::ofstream list(folder.path() / bundle::manifest_name, std::ios::binary);
  list << text_of(manifest);
  if (!list.flush()) throw Error(Exit::io, std::string(bundle::manifest_name) + ": cannot be written");
  bundle::pack(folder.path(), names, words.out);

  const std::string id = bundle::sha256_of(folder.path() / bundle::manifest_name);
  if (words.json) {
    Json json{{"world", world.name},
              {"seed", world.seed},
              {"ticks", world.ticks},
              {"digest", manifest.waymarks.back().digest},
              {"list", id},
              {"file", words.out},
              {"files", Json::array()}};
    for (const bundle::ListedFile& file : manifest.files) json["files"].push_back(file.name);
    fmt::print("{}\n", json.dump(2));
    return Exit::done;
  }
  fmt::print("{}: {} ticks, digest {}, twice: where it lies and out of the bundle\n", world.name, world.ticks,
             manifest.waymarks.back().digest);
  for (const bundle::ListedFile& file : manifest.files)
    if (!file.named.empty()) fmt::print("  {} is {} in the bundle\n", file.named, file.name);
  fmt::print("  {} files, {} of them plugins; list {}\n  wrote {}\n", manifest.files.size(), manifest.plugins.size(),
             id, words.out);
  return Exit::done;
}

void refuse_given(bool is_given, const char* option, const char* of) {
  if (is_given) throw Error(Exit::invalid_input, fmt::format("{} is of {}", option, of));
}

Exit check_words(const BundleWords& words) {
  const char* making = "the making of a bundle, which keeps it; expected it at `muster bundle WORLD`";
  refuse_given(words.until.has_value(), "--until", making);
  refuse_given(words.seed.has_value(), "--seed", making);
  refuse_given(!words.set.empty(), "--set", making);
  refuse_given(!words.data.empty(), "--data", making);
  if (words.plugins_of_bundle && !words.plugins.empty())
    throw Error(Exit::invalid_input, "--plugins and --plugins-of-bundle exclude each other; expected one of them");
  if (const std::string& given = words.subject[1]; fs::is_directory(given) || file_kind_of(given) == "XML")
    throw Error(Exit::invalid_input, given + " is a world, and no bundle; expected muster bundle " + given +
                                         " --out NAME.tar.zst, which makes one");
  return check_bundle(
      {words.subject[1], words.out, words.plugins, words.workers, !words.plugins_of_bundle, words.json});
}

}  // namespace

int run_bundle(const Arguments& arguments) {
  CommandLine line(
      "bundle",
      "A run in one file: world, plugins, models, data, seed and options, with SHA-256 of each, and the "
      "digest that it came to.\n"
      "  WORLD       makes it; the world is run twice, where it lies and out of the bundle\n"
      "  check FILE  says whether it is whole, what differs on this machine, and whether the digest is the "
      "same here;\n"
      "              exit code 1 where it is not\n"
      "Example: muster bundle worlds/connectivity --until 20 --out out/connectivity.tar.zst\n"
      "         then: muster bundle check out/connectivity.tar.zst");
  BundleWords words;
  line.option("world", words.subject, "the world's folder or file; or the word check and a bundle").required();
  line.option("-o,--out", words.out, "the .tar.zst to write, a new file; check: a new folder to keep what is in it");
  line.option("--until", words.until, "end of the run in seconds, instead of the world's");
  line.option("--seed", words.seed, "seed of all random numbers, instead of the world's");
  line.option("--set", words.set, "PATH=VALUE: a parameter of the world or of a plugin").one_word_each();
  line.option("--data", words.data, "a file that goes with the world, such as readings").one_word_each();
  line.option("--plugins", words.plugins, "a folder of plugins, looked in first").one_word_each();
  line.flag("--plugins-of-bundle", words.plugins_of_bundle,
            "check: run the bundle's plugins instead of this machine's; they are code of whoever made it");
  line.option("--workers", words.workers, "threads; the results do not depend on it").within(1, 256);
  line.flag("--json", words.json, "print the outcome as JSON");
  line.parse(arguments);
  const bool checks = words.subject[0] == "check" && words.subject.size() == 2;
  if (checks) return static_cast<int>(check_words(words));
  if (words.subject[0] == "check")
    throw Error(Exit::invalid_input, "check: expected one FILE after it; a world of that name is ./check");
  if (words.subject.size() != 1)
    throw Error(Exit::invalid_input, "expected one WORLD, or check FILE; " + quote(words.subject[1]) + " is too much");
  refuse_given(words.plugins_of_bundle, "--plugins-of-bundle", "`muster bundle check FILE`");
  if (const std::string& given = words.subject[0];
      given.ends_with(archive_ending) || file_kind_of(given) == "compressed by zstd")
    throw Error(Exit::invalid_input,
                given + " is a bundle, and no world; did you mean muster bundle check " + given + "?");
  if (words.out.empty()) throw Error(Exit::invalid_input, "--out is missing; expected a file to write, NAME.tar.zst");
  if (!words.out.ends_with(archive_ending))
    throw Error(Exit::invalid_input, "--out: " + quote(words.out) + " does not end in " + archive_ending +
                                         "; expected NAME" + archive_ending);
  if (fs::exists(fs::symlink_status(words.out)))
    throw Error(Exit::invalid_input, "--out: " + words.out + " is there already; expected a new file");
  return static_cast<int>(make_bundle(words));
}

}  // namespace muster::cli
