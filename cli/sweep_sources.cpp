#include "sweep_sources.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <iterator>
#include <muster/random.hpp>
#include <set>

#include "run_options.hpp"
#include "text/names.hpp"

namespace muster::cli {
namespace {

namespace fs = std::filesystem;

const std::string own_file = "sweep", program = "program", plugin = "plugin ";  // names of sources that are no paths

// The file, and what its attributes name beside it; so on from XML to XML.
void add_named(const fs::path& file, std::set<fs::path>& found) {
  if (!found.insert(file.lexically_normal()).second) return;
  static const std::set<std::string> readable{".xml", ".urdf"};
  if (!readable.count(file.extension().string())) return;
  const std::function<void(const XmlElement&)> look = [&](const XmlElement& element) {
    for (const XmlAttribute& given : element.attributes) {
      std::error_code none;
      const fs::path named = file.parent_path() / given.value;
      if (!given.value.empty() && fs::is_regular_file(named, none)) add_named(named, found);
    }
    for (const XmlElement& child : element.children) look(child);
  };
  try {
    look(read_xml(file));
  } catch (const Error&) {  // whoever reads it tells
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

sweep::Sources sources_of(const sweep::SweepFile& file, const std::vector<fs::path>& libraries,
                          const Library::SearchPath& plugins) {
  std::set<fs::path> files;
  const auto add_world = [&](const sweep::Word& world) {
    const fs::path path = file.beside(world.text);
    add_named(fs::is_directory(path) ? path / "world.xml" : path, files);
  };
  if (!file.world.text.empty()) add_world(file.world);
  for (const sweep::Variation& each : file.varied) {
    if (each.kind == sweep::Variation::Kind::world) std::for_each(each.values.begin(), each.values.end(), add_world);
  }
  std::set<std::string> names{own_file, program};
  for (const fs::path& library : libraries) {
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
