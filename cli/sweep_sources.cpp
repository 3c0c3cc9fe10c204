#include "sweep_sources.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <muster/random.hpp>
#include <set>

#include "run_options.hpp"
#include "text/names.hpp"

namespace muster::cli {
namespace {

namespace fs = std::filesystem;

const std::string own_file = "sweep", program = "program", plugin = "plugin ";  // names of sources that are no paths

// Whether the sweep names the world by an absolute path: its files are then the same wherever the sweep's lies.
bool is_absolute(const fs::path& world, const sweep::SweepFile& file) {
  const auto names_it = [&](const sweep::Word& word) {
    const fs::path given(word.text);
    return given.is_absolute() && (world == given || world == given / "world.xml");
  };
  return names_it(file.world) || std::any_of(file.varied.begin(), file.varied.end(), [&](const auto& each) {
           return each.kind == sweep::Variation::Kind::world &&
                  std::any_of(each.values.begin(), each.values.end(), names_it);
         });
}

// All that a world reads.
void add_files(const fs::path& world, const bundle::WorldFiles& read, const sweep::SweepFile& file,
               std::set<std::string>& names) {
  static const std::string of_plugins = "plugins/";  // the folder of a bundle
  const fs::path folder = fs::absolute(file.beside(".")).lexically_normal();
  for (const auto& [name, each] : read.files()) {
    if (name.starts_with(of_plugins))
      names.insert(plugin + name.substr(of_plugins.size()));
    else
      names.insert((is_absolute(world, file) ? each.source : each.source.lexically_relative(folder)).string());
  }
}

// The first of that name on the path, as a plugin is found; empty if there is none.
fs::path on_path(const std::string& name, const Library::SearchPath& plugins) {
  for (const fs::path& folder : plugins) {
    if (fs::exists(folder / name)) return folder / name;
  }
  return {};
}

fs::path path_of(const std::string& name, const sweep::SweepFile& file, const Library::SearchPath& plugins) {
  if (name == own_file) return file.file;
  if (name == program) return "/proc/self/exe";
  if (name.starts_with(plugin)) return on_path(name.substr(plugin.size()), plugins);
  return file.beside(name);
}

}  // namespace

std::string digest_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return "";
  const std::string bytes(std::istreambuf_iterator<char>(in), {});
  return hexadecimal(key_of(bytes));
}

sweep::Sources sources_of(const sweep::SweepFile& file, const SweepRuns::Checked& checked,
                          const Library::SearchPath& plugins) {
  std::set<fs::path> files;
  std::set<std::string> names{own_file, program};
  for (const auto& [world, read] : checked.worlds) add_files(world, read, file, names);
  for (const fs::path& library : checked.libraries) {
    const std::string name = library.filename().string();
    std::error_code none;
    if (fs::equivalent(on_path(name, plugins), library, none))
      names.insert(plugin + name);
    else
      files.insert(library);  // that a world names by its file
  }
  // Models of robots lie beside the plugins.
  for (const fs::path& each : plugins) {
    std::error_code none;
    for (const auto& model : fs::directory_iterator(each / "models", none))
      names.insert(plugin + "models/" + model.path().filename().string());
  }
  const fs::path folder = file.file.has_parent_path() ? file.file.parent_path() : fs::path(".");
  for (const fs::path& each : files) {
    names.insert(each.is_absolute() ? each.string() : each.lexically_relative(folder.lexically_normal()).string());
  }
  sweep::Sources result;
  for (const std::string& name : names) result[name] = digest_of(path_of(name, file, plugins));
  return result;
}

void expect_unchanged(const sweep::Sources& then, const sweep::SweepFile& file, const Library::SearchPath& plugins,
                      const fs::path& folder) {
  for (const auto& [name, digest] : then) {
    const fs::path path = path_of(name, file, plugins);
    if (digest_of(path) == digest) continue;
    const std::string what = name == own_file  ? file.file.string()
                             : name == program ? "muster itself"
                             : path.empty()    ? name
                                               : path.string();
    throw Error(Exit::invalid_input,
                fmt::format("{} is not what it was when the runs in {} were begun; expected another folder (--out), so "
                            "that runs of both are not mixed",
                            what, folder.string()));
  }
}

}  // namespace muster::cli
