// muster new KIND NAME: a project outside the tree, made from the skeletons of templates/.
#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cerrno>
#include <fstream>

#include "installation.hpp"
#include "text/json.hpp"
#include "text/names.hpp"
#include "text/text_file.hpp"
#include "verbs.hpp"

namespace muster::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t most_bytes = 1u << 20;  // of a file of a skeleton
constexpr std::size_t longest_name = 60;        // letters; file names are a little longer

const std::string mark = "skeleton", type_mark = "Skeleton";

bool is_small(char c) { return c >= 'a' && c <= 'z'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_capital(char c) { return c >= 'A' && c <= 'Z'; }

// As the loader wants ids of plugins: they are file names, and names in world files.
bool is_plugin_name(const std::string& text) {
  return !text.empty() && text.size() <= longest_name && is_small(text[0]) &&
         std::all_of(text.begin(), text.end(), [](char c) { return is_small(c) || is_digit(c) || c == '_'; });
}

// "My-Model" becomes my_model; empty where nothing is left.
std::string nearest_plugin_name(const std::string& text) {
  std::string result;
  for (std::size_t i = 0; i < text.size() && result.size() < longest_name; ++i) {
    const char c = text[i];
    const bool begins_word = is_capital(c) && i > 0 && (is_small(text[i - 1]) || is_digit(text[i - 1]));
    if (begins_word && !result.empty() && result.back() != '_') result += '_';
    if (is_capital(c))
      result += static_cast<char>(c - 'A' + 'a');
    else if (is_small(c) || (is_digit(c) && !result.empty()))
      result += c;
    else if (!result.empty() && result.back() != '_')
      result += '_';
  }
  while (!result.empty() && result.back() == '_') result.pop_back();
  return result;
}

// "range_loss" becomes RangeLoss.
std::string type_name(const std::string& name) {
  std::string result;
  bool begins = true;
  for (const char c : name) {
    if (c != '_') result += begins && is_small(c) ? static_cast<char>(c - 'a' + 'A') : c;
    begins = c == '_';
  }
  return result;
}

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (auto at = text.find(from); at != text.npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

std::string filled(std::string text, const std::string& name) {
  replace_all(text, mark, name);
  replace_all(text, type_mark, type_name(name));
  return text;
}

// A folder each; none where the installation lacks them.
std::vector<std::string> kinds_in(const fs::path& templates) {
  std::vector<std::string> result;
  std::error_code failed;
  for (const auto& entry : fs::directory_iterator(templates, failed)) {
    if (entry.is_directory()) result.push_back(entry.path().filename().string());
  }
  std::sort(result.begin(), result.end());
  return result;
}

std::vector<fs::path> files_of(const fs::path& skeleton) {
  std::vector<fs::path> result;
  for (const auto& entry : fs::directory_iterator(skeleton)) {
    if (entry.is_regular_file()) result.push_back(entry.path());
  }
  std::sort(result.begin(), result.end());
  return result;
}

// The word that stands before the dot of a skeleton's plugin, "control"; "" where it is none.
std::string family_of(const std::vector<fs::path>& skeleton) {
  for (const fs::path& file : skeleton) {
    const std::string stem = file.stem().string();
    if (file.extension() == ".cpp" && stem.ends_with("_" + mark)) return stem.substr(0, stem.size() - mark.size() - 1);
  }
  return "";
}

// "follow" of "control.follow", "control_follow" and "controller.follow"; "" where the kind does not stand before it.
std::string without_kind(const std::string& name, const std::string& family, const std::string& kind) {
  if (family.empty()) return "";
  for (const std::string& begin : {family + '.', family + '_', family + '-', kind + '.'}) {
    std::string rest = nearest_plugin_name(name.substr(std::min(begin.size(), name.size())));
    if (name.starts_with(begin) && !rest.empty()) return rest;
  }
  return "";
}

// A plugin of the same name would hide the one that worlds mean now, or be hidden by it.
void refuse_taken(const std::vector<fs::path>& skeleton, const std::string& name) {
  const std::string family = family_of(skeleton);
  const auto taken = [&](const std::string& by) {
    const auto folders = plugin_path();
    return !family.empty() && std::any_of(folders.begin(), folders.end(), [&](const fs::path& folder) {
      return fs::exists(folder / (family + "_" + by + ".so"));
    });
  };
  if (!taken(name)) return;
  int number = 2;
  while (taken(fmt::format("{}_{}", name, number))) ++number;
  throw Error(Exit::invalid_input, fmt::format("there is a plugin {}.{} already; expected a new name, such as {}",
                                               family, name, quote(fmt::format("{}_{}", name, number))));
}

void write_file(const fs::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  out << text;
  if (!out.flush()) throw Error(Exit::io, {file.string()}, "cannot be written: " + system_message(errno));
}

// Whole, or not at all.
std::vector<std::string> write_project(const std::vector<fs::path>& skeleton, const std::string& name,
                                       const fs::path& folder) {
  std::error_code ignored;
  if (fs::exists(fs::symlink_status(folder, ignored)))
    throw Error(Exit::invalid_input, {folder.string()}, "exists already; expected a new folder");
  std::vector<std::string> written;
  fs::create_directories(folder);
  try {
    for (const fs::path& file : skeleton) {
      written.push_back(filled(file.filename().string(), name));
      write_file(folder / written.back(), filled(read_text_file(file, most_bytes).text, name));
    }
  } catch (...) {
    fs::remove_all(folder, ignored);
    throw;
  }
  return written;
}

// What cmake is to be told where it does not look by itself.
std::string package_option(const fs::path& package) {
  for (const char* prefix : {"/usr", "/usr/local"}) {
    if (package == fs::path(prefix) / "lib" / "cmake" / "muster") return "";
  }
  const std::string path = package.string();
  return " -D muster_DIR=" + (path.find(' ') == path.npos ? path : '"' + path + '"');
}

}  // namespace

int run_new(const Arguments& arguments) {
  const fs::path templates = installation().shared / "templates";
  CommandLine line("new",
                   "Writes a small project outside the tree: CMakeLists.txt, a source, a world, a test and a page, "
                   "which build, pass and run.\n"
                   "docs/how-to/install.md goes on from there.\n"
                   "Example: muster new radio range_loss --in plugins");
  std::string kind, name, in = ".";
  bool json = false;
  const auto kinds = kinds_in(templates);
  auto kind_option = line.option("kind", kind, "what it is to be").required();
  if (!kinds.empty()) kind_option.one_of(kinds);
  line.option("name", name, "its name: small letters, digits and _").required();
  line.option("--in", in, "the folder in which its folder is made").shows_default();
  line.flag("--json", json, "print the outcome as JSON");
  line.parse(arguments);

  if (kinds.empty())
    throw Error(Exit::io, {templates.string()}, "has no skeletons; expected a folder each, as installed");
  const auto skeleton = files_of(templates / kind);
  const std::string family = family_of(skeleton), meant = is_plugin_name(name) ? name : nearest_plugin_name(name);
  for (const std::string& each : {name, meant}) {
    const std::string rest = without_kind(each, family, kind);
    if (!rest.empty())
      throw Error(Exit::invalid_input,
                  fmt::format("{} has its kind in it, which is put before the name; expected muster "
                              "new {} {}, which makes {}.{}",
                              quote(name), kind, rest, family, rest));
  }
  if (!is_plugin_name(name)) {
    const std::string near = nearest_plugin_name(name);
    throw Error(Exit::invalid_input,
                fmt::format("{} is no name of a plugin; expected a small letter, then small letters, digits and _, at "
                            "most {} in all{}",
                            quote(name), longest_name, near.empty() ? "" : "; did you mean " + quote(near) + "?"));
  }
  refuse_taken(skeleton, name);
  const fs::path folder = (fs::path(in) / name).lexically_normal();
  const auto written = write_project(skeleton, name, folder);

  const fs::path package = installation().package;
  const bool has_package = fs::exists(package / "muster-config.cmake");
  if (json) {
    fmt::print("{}\n", Json{{"kind", kind},
                            {"name", name},
                            {"folder", folder.string()},
                            {"files", written},
                            {"muster_DIR", has_package ? Json(package.string()) : Json()}}
                           .dump(2));
    return 0;
  }
  fmt::print("wrote {}: {}\n", folder.string(), fmt::join(written, ", "));
  if (!has_package)
    fmt::print("to build it, install muster-dev: {} is missing\n", (package / "muster-config.cmake").string());
  fmt::print("next, in {}:\n  cmake -B build{} && cmake --build build && ctest --test-dir build\n", folder.string(),
             has_package ? package_option(package) : "");
  return 0;
}

}  // namespace muster::cli
