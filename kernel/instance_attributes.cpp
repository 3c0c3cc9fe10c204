// The attributes that a world gives an instance, checked against what its plugin declares.
#include <algorithm>

#include "instance.hpp"
#include "instance_doubts.hpp"
#include "text/names.hpp"
#include "world_file/kinds.hpp"
#include "world_file/params.hpp"

namespace muster {
namespace {

// Of an attribute that names one row: a word for each of them.
bool means_all(const std::string& row) {
  for (const char* word : {"all", "any", "every", "everyone", "broadcast", "*"}) {
    if (row == word) return true;
  }
  return false;
}

// A row's name where a choice is wanted, and another attribute takes names: "base" of <sensors.range to="base"/>.
void refuse_row_as_choice(const muster_plugin& plugin, const muster_param& param, const XmlAttribute& given,
                          const Blackboard& board) {
  const auto words = choices(param);
  if (std::find(words.begin(), words.end(), given.value) != words.end()) return;
  for (const char* name : {"radio", "robot"}) {
    const Set* set = board.find_set(name);
    if (!set || set->find(given.value) < 0) continue;
    for (uint32_t i = 0; i < plugin.param_count; ++i) {
      const muster_param& other = plugin.params[i];
      const bool takes_it =
          other.kind == MUSTER_REFERENCE
              ? std::string(other.text) == name
              : other.kind == MUSTER_TEXT && std::string(other.help).starts_with("names of " + std::string(name));
      if (!takes_it) continue;
      throw invalid(given.value_place, "attribute " + quote(given.name) + ": " + quote(given.value) +
                                           " is not a choice, but a " + name + "; " + expected_one_of(words) + ", or " +
                                           other.name + "=\"" + given.value + "\" in its place");
    }
  }
}

// A reference in a plugin's source to a set that is none: "robots" for "robot".
void refuse_unknown_set(const muster_param& param, const muster_plugin& plugin, const Blackboard& board,
                        const std::string& row, const Place& place) {
  std::vector<std::string> sets;
  for (const auto& [name, set] : board.sets()) {
    if (set->is_named() && set->find(row) >= 0 && name.find('/') == name.npos) sets.push_back(name);
  }
  const std::string near = nearest(param.text, sets);
  if (near.empty()) return;  // one on demand, of which this world has no row
  throw Error(Exit::plugin_fault, place,
              std::string(plugin.id) + ": its parameter " + quote(param.name) + " refers to rows of " +
                  quote(param.text) + ", which is no set; expected reference(" + quote(param.name) + ", " +
                  quote(near) + ", ...) in its source");
}

}  // namespace

void Instance::check_attributes() {
  std::vector<std::string> valid = reserved_attributes;
  for (uint32_t i = 0; i < plugin_->param_count; ++i) {
    const auto& param = plugin_->params[i];
    valid.push_back(param.name);
    params_.push_back(param.value);
    if (declared_.shares_element &&
        std::find(swap_attributes.begin(), swap_attributes.end(), param.name) != swap_attributes.end())
      throw invalid(
          declared_.place,
          "<swap> takes the attribute " + quote(param.name) + " for itself, but " + declared_.plugin +
              " has one of that name; expected the plugin as an element inside: <swap at=\"...\" instance=\"...\"><" +
              declared_.plugin + " .../></swap>");
    if (param.kind == MUSTER_TEXT || param.kind == MUSTER_FILE) texts_[param.name] = param.text ? param.text : "";
  }
  const muster_param* asked = nullptr;
  const FindRow find_row = [&](const std::string& set, const std::string& row, const Place& place) -> double {
    const Set* found = around_.board->find_set(set);
    if (!found && asked) refuse_unknown_set(*asked, *plugin_, *around_.board, row, declared_.place);
    if (!found || found->find(row) < 0)
      throw invalid(place, "no " + set + " is called " + quote(row) +
                               (around_.world ? which_is(*around_.world, row, set) : "") + "; " +
                               (found && !found->names.empty() ? suggest(row, found->names) : "the world has none") +
                               (means_all(row) && asked && !(asked->flags & MUSTER_REQUIRED)
                                    ? "; for that, leave " + quote(asked->name) + " out (" + asked->help + ')'
                                    : ""));
    return found->find(row);
  };
  const Warn warn = [this](const Place& place, const std::string& message) {
    events.push_back("warning: " + place.text() + ": " + message);
  };
  for (const auto& given : declared_.attributes) {
    const int found = find_param(given.name);
    if (found < 0) refuse_unknown(given, declared_.plugin, valid);
    const auto& param = plugin_->params[found];
    asked = &param;
    if (param.kind == MUSTER_CHOICE) refuse_row_as_choice(*plugin_, param, given, *around_.board);
    const auto values = attribute_values(param, 1, given, find_row, warn);
    if (values.empty())
      texts_[given.name] = given.value;
    else
      params_[static_cast<std::size_t>(found)] = values[0];
    places_[given.name] = given.value_place;
  }
  for (uint32_t i = 0; i < plugin_->param_count; ++i) {
    const auto& param = plugin_->params[i];
    if ((param.flags & MUSTER_REQUIRED) && !places_.count(param.name))
      throw invalid(declared_.place, "<" + declared_.plugin + "> has no attribute " + quote(param.name) +
                                         ", which it needs; expected " + expectation(param));
  }
  check_together(*plugin_, params_, declared_, *around_.world, warn);
}

}  // namespace muster
