#include "parameter_words.hpp"

#include <algorithm>
#include <cctype>

#include "text/names.hpp"

namespace muster {
namespace {

std::string owner_of(const std::string& path) { return path.substr(0, path.rfind('/')); }

// True if the help has the word as one of its own.
bool explains(const std::string& help, const std::string& word) {
  constexpr std::size_t telling = 4;  // letters
  const auto is_letter = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
  for (auto at = help.find(word); word.size() >= telling && at != help.npos; at = help.find(word, at + 1)) {
    const auto end = at + word.size();
    if ((at == 0 || !is_letter(help[at - 1])) && (end == help.size() || !is_letter(help[end]))) return true;
  }
  return false;
}

// True if `word` is one of the parameter's choices, "open" of "closed|open".
bool chooses(const muster_param& declared, const std::string& word) {
  const std::string choices = '|' + std::string(declared.text ? declared.text : "") + '|';
  return declared.kind == MUSTER_CHOICE && choices.find('|' + word + '|') != choices.npos;
}

}  // namespace

std::string unknown_parameter(const std::string& path, const std::vector<ParameterInfo>& all,
                              const std::string& owner_by_plugin) {
  const std::string what = "there is no parameter " + quote(path) + "; ", owner = owner_of(path);
  const std::string name = path.substr(path.find('/') == path.npos ? 0 : owner.size() + 1);
  std::vector<std::string> valid, below, own, meant;
  for (const auto& info : all) {
    valid.push_back(info.path);
    if (info.path.starts_with(path + '/')) below.push_back(info.path);
    if (owner_of(info.path) != owner) continue;
    own.push_back(info.path.substr(owner.size() + 1));
    if (explains(info.declared->help, name)) meant.push_back(own.back());
    if (chooses(*info.declared, name))
      return what + quote(name) + " is a value of " + quote(info.path) + "; expected that path, and the value " + name;
  }
  if (valid.empty()) return what + "this world has none, as no plugin has any or reads its elements";
  if (!below.empty()) return what + "it has several: " + expected_one_of(below);
  if (own.empty() && !owner_by_plugin.empty())
    return what + owner + " is the plugin of " + quote(owner_by_plugin) + "; did you mean " +
           quote(owner_by_plugin + '/' + name) + "?";
  if (own.empty() && path.find('/') == path.npos) {  // "n" of "radio.multiwall/n"
    std::vector<std::string> ends;
    for (const std::string& each : valid)
      if (each.ends_with('/' + path)) ends.push_back(each);
    if (ends.size() == 1) return what + "did you mean " + quote(ends[0]) + "? " + expected_one_of(valid);
    if (!ends.empty()) return what + "parameters have the name of their instance before them: " + expected_one_of(ends);
  }
  if (own.empty()) return what + suggest(path, valid);
  const std::string near = meant.size() == 1 ? meant[0] : nearest(name, own);
  for (std::string& each : own) each = owner + '/' + each;
  return what + expected_one_of(own) + (near.empty() ? "" : "; did you mean " + quote(owner + '/' + near) + "?");
}

namespace {

// A number of a controller's, if there is one of that row's robot rather than of another's; "" where there is none.
std::string likely_parameter(const Simulation& run, int row) {
  std::string found;
  for (const auto& instance : run.instances()) {
    const bool is_own = row >= 0 && instance->bound_row() == row;
    if (instance->phase() != MUSTER_CONTROL || (!found.empty() && !is_own)) continue;
    for (uint32_t i = 0; i < instance->plugin().param_count; ++i) {
      if (instance->plugin().params[i].kind != MUSTER_REAL) continue;
      found = instance->name() + '/' + instance->plugin().params[i].name;
      if (is_own) return found;
      break;
    }
  }
  return found;
}

// What an attribute is that no number stands for.
std::string kind_of(const muster_param& declared) {
  if (declared.kind == MUSTER_FILE) return "a file";
  return declared.kind == MUSTER_REFERENCE ? "the name of a " + std::string(declared.text) : "a text";
}

}  // namespace

bool is_settable(const muster_param& declared) {
  return declared.kind != MUSTER_TEXT && declared.kind != MUSTER_FILE && declared.kind != MUSTER_REFERENCE;
}

std::string fixed_attribute(const Instance& instance, const std::string& path) {
  const auto slash = path.rfind('/');
  const int number =
      slash != path.npos && instance.name() == path.substr(0, slash) ? instance.find_param(path.substr(slash + 1)) : -1;
  if (number < 0 || is_settable(instance.plugin().params[number])) return "";
  const auto& param = instance.plugin().params[number];
  return quote(path) + " is " + kind_of(param) + ", and no parameter: numbers, flags and choices are; expected " +
         param.name + "=\"...\" in the world, at " + instance.place().text();
}

std::string fixed_attribute_of_row(const World& world, const Standard& standard, const std::string& path) {
  const std::string owner = owner_of(path), name = path.substr(std::min(owner.size() + 1, path.size()));
  const auto row = std::find_if(world.rows.begin(), world.rows.end(),
                                [&](const RowDeclaration& each) { return each.set + '/' + each.name == owner; });
  if (row == world.rows.end()) return "";
  for (const Element& element : standard.elements) {
    if (element.set != row->set) continue;
    for (const Attribute& attribute : element.attributes) {
      const bool is_list = attribute.count > 1 && is_settable(attribute.param);
      if (attribute.param.name != name || (is_settable(attribute.param) && !is_list)) continue;
      const std::string what = is_list ? std::to_string(attribute.count) + " numbers" : kind_of(attribute.param);
      return quote(path) + " is " + what + ", and no parameter: single numbers, flags and choices are; expected " +
             name + "=\"...\" of <" + element.name + ">, at " + row->place.text();
    }
  }
  return "";
}

std::string swap_with(const InstanceDeclaration& now, const std::string& name, const std::string& value) {
  std::string result = "<swap instance=\"" + now.name + "\"><" + now.plugin;
  const auto add = [&](const std::string& each, const std::string& text) { result += ' ' + each + "=\"" + text + '"'; };
  if (now.every > 1) add("every", std::to_string(now.every));
  if (now.library) add("library", now.library->string());
  if (now.revision) add("revision", std::to_string(*now.revision));
  for (const XmlAttribute& given : now.attributes) add(given.name, given.name == name ? value : given.value);
  if (!now.attribute(name)) add(name, value);
  return result + "/></swap>";
}

namespace {

// How a robot goes on at another place: by one of another name, as names and their controllers are for the whole run.
std::string elsewhere(const Simulation& run, const std::string& path) {
  std::string name = path.substr(6, path.find('/', 6) - 6);
  if (name == "*") name = "NAME";
  std::string other = name + "_2";
  const Set* robots = run.board().find_set("robot");
  for (int number = 3; robots && robots->find(other) >= 0; ++number) other = name + '_' + std::to_string(number);
  return "; to put the robot elsewhere, in an <at>: <leave robot=\"" + name + "\"/>, <robot name=\"" + other +
         "\" model=\"...\" at=\"X Y Z\"/>, which joins there, and a controller with robot=\"" + other + '"';
}

}  // namespace

std::string fault_of_row(const Simulation& run, const std::string& path) {
  const std::string owner = owner_of(path), name = path.substr(std::min(owner.size() + 1, path.size()));
  const auto& rows = run.world().rows;
  const auto robot = std::find_if(
      rows.begin(), rows.end(), [&](const RowDeclaration& each) { return each.set == "robot" && each.name == owner; });
  const Set* robots = run.board().find_set("robot");
  if (robot == rows.end() || !robots) return "";
  std::vector<std::string> own;
  for (const auto& instance : run.instances()) {
    if (instance->phase() != MUSTER_CONTROL || instance->bound_row() != robots->find(owner)) continue;
    const std::string begin = quote(owner) + " is a robot (" + robot->place.text() + ") and has no parameters; ";
    for (uint32_t i = 0; i < instance->plugin().param_count; ++i) {
      const muster_param& param = instance->plugin().params[i];
      if (!is_settable(param)) continue;
      own.push_back(instance->name() + '/' + param.name);
      if (name == param.name)
        return begin + "did you mean " + quote(own.back()) + ", of its controller " + instance->declared().plugin + '?';
    }
    if (!own.empty()) return begin + "its controller " + instance->declared().plugin + " has " + listed(own);
  }
  return "";
}

std::string state_fault(const Simulation& run, const std::string& path) {
  const auto view = run.find_table(path.substr(0, path.rfind('/')));
  if (!view || view->table->columns().find(path.substr(path.rfind('/') + 1)) < 0) return "";
  const std::string such = likely_parameter(run, view->row);
  return quote(path) + " is a state, which plugins write, and no parameter; expected a parameter" +
         (such.empty() ? "" : ", such as " + such) + (path.rfind("robot/", 0) == 0 ? elsewhere(run, path) : "");
}

}  // namespace muster
