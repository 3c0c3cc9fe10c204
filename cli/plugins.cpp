// muster plugins and muster describe: what can be loaded, and the manual of a plugin or of a world file's element from
// its declarations alone.
#include <fmt/core.h>

#include <algorithm>

#include "text/json.hpp"
#include "text/names.hpp"
#include "text/number.hpp"
#include "verbs.hpp"
#include "world_file/params.hpp"

namespace muster::cli {
namespace {

std::string default_text(const muster_param& param) {
  if (param.flags & MUSTER_REQUIRED) return "required";
  if (param.kind == MUSTER_TEXT || param.kind == MUSTER_FILE)
    return param.text && *param.text ? quote(param.text) : "none";
  if (param.kind == MUSTER_REFERENCE) return "none";
  return value_text(param, param.value) + (*param.unit ? std::string(" ") + param.unit : "");
}

Json param_json(const muster_param& param) {
  Json result = {{"name", param.name},
                 {"default", default_text(param)},
                 {"expected", expectation(param)},
                 {"unit", param.unit},
                 {"help", param.help},
                 {"free", (param.flags & MUSTER_FREE) != 0}};
  return result;
}

void print_cause(const muster_cause& cause) {
  fmt::print("\n  A cause: {}\n", cause.title);
  if (*cause.covariates) fmt::print("  Needs the columns: {}\n", cause.covariates);
  if (*cause.imitators) fmt::print("  Can be mistaken for: {}\n", cause.imitators);
  if (*cause.tell_apart) fmt::print("  To decide: {}\n", cause.tell_apart);
}

// What it declares of its randomness, for a diagnosis.
void print_laws(const muster_plugin& plugin) {
  if (const muster_law* law = plugin.law)
    fmt::print("\n  States a law of single readings, of strength {}.\n", law->strength);
  if (const muster_draw* draw = plugin.draw)
    fmt::print("\n  States how its draws are correlated: of size {}, over {}.\n", draw->scale, draw->distance);
  if (const muster_clip* clip = plugin.clip)
    fmt::print("\n  Clips readings {} {}.\n", clip->side == MUSTER_ABOVE ? "above" : "below", clip->level);
  if (const muster_burst* burst = plugin.burst)
    fmt::print("\n  Takes {} from the link of {} and {} in bursts.\n", burst->loss, burst->one, burst->other);
}

// An attribute of `count` values.
void print_param(const muster_param& param, int count) {
  const bool required = param.flags & MUSTER_REQUIRED;
  fmt::print("    {:14} {}\n    {:14} {}{}; {}{}{}\n", param.name, param.help, "", expectation(param),
             count > 1 ? fmt::format(", {} of these", count) : "", required ? "" : "default ", default_text(param),
             param.flags & MUSTER_FREE ? "; a fit may free it" : "");
}

void print_manual(const Library& library, const muster_plugin& plugin) {
  fmt::print("{}  ({})\n  {}\n\n  phase {}, from {}\n", plugin.id, phase_name(plugin.phase), plugin.summary,
             phase_name(plugin.phase), library.file().string());
  if (plugin.manual) {
    fmt::print("\n");
    std::string line;
    for (const char* c = plugin.manual;; ++c) {
      if (*c && *c != '\n') {
        line += *c;
        continue;
      }
      fmt::print("  {}\n", line);
      line.clear();
      if (!*c) break;
    }
  }
  if (plugin.cause) print_cause(*plugin.cause);
  print_laws(plugin);
  if (plugin.cannot_hold) fmt::print("\n  A swap to it drops: {}.\n", plugin.cannot_hold);
  if (plugin.param_count) fmt::print("\n  Attributes, beside {}:\n", expected_one_of(reserved_attributes).substr(16));
  for (uint32_t i = 0; i < plugin.param_count; ++i) print_param(plugin.params[i], 1);
}

// Of a world file's element that is no plugin.
void describe_element(const std::string& name, bool json, const std::vector<std::filesystem::path>& folders) {
  std::vector<std::string> names;
  for (const auto& element : standard().elements) {
    names.emplace_back(element.name);
    if (name != element.name) continue;
    Json out = {{"element", element.name}, {"summary", element.help}, {"params", Json::array()}};
    for (const auto& attribute : element.attributes) {
      Json param = param_json(attribute.param);
      param["count"] = std::max(1, attribute.count);
      out["params"].push_back(std::move(param));
    }
    if (json) return fmt::print("{}\n", out.dump(2));
    fmt::print("<{}>  an element of a world file\n  {}\n\n  Attributes{}:\n", element.name, element.help,
               *element.file_of ? "" : ", beside name");
    for (const auto& attribute : element.attributes) print_param(attribute.param, attribute.count);
    return;
  }
  if (name.find('/') != name.npos)
    throw Error(Exit::invalid_input,
                "there is no plugin or element " + quote(name) +
                    "; is this a table? muster graph WORLD lists those of a world, and who writes them");
  for (const auto& folder : folders) {
    if (std::filesystem::exists(folder / "models" / (name + ".urdf")))
      throw Error(Exit::invalid_input, "there is no element " + quote(name) +
                                           ", but a model: <robot model=" + quote(name) + "/>, described by " +
                                           (folder / "models" / (name + ".urdf")).string());
  }
  std::vector<std::string> family;     // plugins whose names begin so: "radio" may mean "radio.multiwall"
  std::vector<std::string> namesakes;  // or end so: "multiwall", or have that file: "radio_multiwall"
  std::string stem = name.ends_with(".so") ? name.substr(0, name.size() - 3) : name;
  for (const auto& one : list_plugins(folders)) {
    if (one.library && std::string(one.library->id()).starts_with(name + ".")) family.emplace_back(one.library->id());
    std::string file = one.library ? std::string(one.library->id()) : "";
    std::replace(file.begin(), file.end(), '.', '_');
    if (one.library && (std::string(one.library->id()).ends_with("." + name) || file == stem))
      namesakes.emplace_back(one.library->id());
  }
  throw Error(Exit::invalid_input, "there is no element " + quote(name) + ", and a plugin has a dot in its name; " +
                                       (!namesakes.empty() ? expected_one_of(namesakes)
                                        : family.empty()   ? suggest(name, names)
                                                           : expected_one_of(family)));
}

}  // namespace

int run_plugins(const Arguments& arguments) {
  CommandLine line("plugins", "Lists the plugins that can be loaded, and why others cannot.\nExample: muster plugins");
  std::vector<std::string> folders;
  bool json = false;
  line.option("--plugins", folders, "a folder of plugins, looked in first");
  line.flag("--json", json, "as JSON");
  line.parse(arguments);
  auto out = Json::array();
  for (const auto& listed : list_plugins(plugin_path(folders))) {
    if (!listed.library) {
      out.push_back({{"file", listed.file.string()}, {"error", listed.reason}});
      if (!json) fmt::print("{:24} {}: {}\n", "-", listed.file.string(), listed.reason);
      continue;
    }
    for (const auto& plugin : listed.library->plugins()) {
      out.push_back({{"id", plugin.id},
                     {"phase", phase_name(plugin.phase)},
                     {"summary", plugin.summary},
                     {"file", listed.file.string()}});
      if (!json) fmt::print("{:24} {:8} {}\n", plugin.id, phase_name(plugin.phase), plugin.summary);
    }
  }
  if (json) fmt::print("{}\n", out.dump(2));
  return 0;
}

int run_describe(const Arguments& arguments) {
  CommandLine line("describe",
                   "Prints the manual of a plugin, or of an element of a world file, from its declarations.\n"
                   "Example: muster describe radio.multiwall\n"
                   "         muster describe wall");
  std::string id;
  std::vector<std::string> folders;
  bool json = false;
  line.option("plugin", id, "its id, or the name of an element").required();
  line.option("--plugins", folders, "a folder of plugins, looked in first");
  line.flag("--json", json, "as JSON");
  line.parse(arguments);
  if (std::filesystem::is_regular_file(id))
    throw Error(Exit::invalid_input,
                "muster describe: " + id + " is a file; expected a plugin or an element (muster check reads a world)");
  if (id.find('.') == std::string::npos || id.ends_with(".so"))
    return describe_element(id, json, plugin_path(folders)), 0;
  const auto library = Library::load(id.substr(0, id.find('/')), {}, plugin_path(folders), {"muster describe"});
  auto out = Json::array();
  for (const auto& plugin : library->plugins()) {
    Json one = {{"id", plugin.id},
                {"phase", phase_name(plugin.phase)},
                {"summary", plugin.summary},
                {"manual", plugin.manual ? plugin.manual : ""},
                {"cannot_hold", plugin.cannot_hold ? plugin.cannot_hold : ""},
                {"params", Json::array()}};
    for (uint32_t i = 0; i < plugin.param_count; ++i) one["params"].push_back(param_json(plugin.params[i]));
    out.push_back(std::move(one));
    if (!json) print_manual(*library, plugin);
  }
  if (json) fmt::print("{}\n", out.dump(2));
  return 0;
}

}  // namespace muster::cli
