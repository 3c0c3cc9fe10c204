#include "world.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "params.hpp"
#include "rows.hpp"
#include "text/names.hpp"
#include "text/number.hpp"

namespace muster {
namespace {

constexpr double most_ticks = 1e12;

double number(const XmlAttribute& given, double least, const char* expected) {
  const auto value = parse_real(given.value);
  if (!value)
    throw invalid(given.value_place,
                  "attribute " + quote(given.name) + ": " + why_not_real(given.value) + "; expected " + expected);
  if (!(*value >= least))
    throw invalid(given.value_place,
                  "attribute " + quote(given.name) + ": " + given.value + " is out of bounds; expected " + expected);
  return *value;
}

uint64_t positive_integer(const XmlAttribute& given) {
  const auto value = parse_integer(given.value);
  if (!value || *value < 1) {
    throw invalid(given.value_place, "attribute " + quote(given.name) + ": " +
                                         (value ? given.value + " is out of bounds" : why_not_integer(given.value)) +
                                         "; expected an integer from 1");
  }
  return static_cast<uint64_t>(*value);
}

const XmlAttribute& needed(const XmlElement& element, const char* name, const char* expected) {
  if (const auto* found = element.attribute(name)) return *found;
  throw lacking(element, name, expected);
}

// Refuses a file of another kind at its first element: what follows in it would give misleading errors.
void check_root(const std::string& name, const Place& place) {
  if (name == "world") return;
  static const std::map<std::string, std::string> others = {
      {"sdf", ", as in a file of Gazebo; muster reads no SDF: expected <world>, with walls, stations and robots in it"},
      {"gazebo", ", as in a file of Gazebo; muster reads no SDF: expected <world>"},
      {"robot",
       ", as in a robot's description; expected <world>, with <robot model=\"FILE.urdf\" at=\"0 0 0\"/> in it"},
      {"mujoco", ", as in a model of MuJoCo; expected <world>"}};
  const auto other = others.find(name);
  throw invalid(place,
                "the root element is <" + name + ">" + (other == others.end() ? "; expected <world>" : other->second));
}

void read_root(const XmlElement& root, World& world) {
  static const std::vector<std::string> valid = {"name", "dt", "until", "seed"};
  world.name = std::filesystem::absolute(world.file).lexically_normal().parent_path().filename().string();
  const XmlAttribute* until = nullptr;
  for (const auto& given : root.attributes) {
    if (given.name == "name")
      world.name = given.value;
    else if (given.name == "dt")
      world.dt = number(given, 1e-9, "the tick in seconds, from 1e-09");
    else if (given.name == "until")
      until = &given;
    else if (given.name == "seed") {
      const auto seed = parse_integer(given.value);
      if (!seed || *seed < 0)
        throw invalid(given.value_place, "attribute \"seed\": " +
                                             (seed ? given.value + " is out of bounds" : why_not_integer(given.value)) +
                                             "; expected an integer from 0");
      world.seed = static_cast<uint64_t>(*seed);
    } else {
      refuse_unknown(given, "world", valid);
    }
  }
  if (!until) throw lacking(root, "until", "the end of the run in seconds, from 0");
  world.ticks = ticks_of(number(*until, 0, "the end of the run in seconds, from 0"), world.dt, until->value_place);
}

bool is_swaps_own(const XmlAttribute& given) {
  return std::find(swap_attributes.begin(), swap_attributes.end(), given.name) != swap_attributes.end();
}

constexpr const char* a_time = "a time in seconds, from 0";

uint64_t tick_of(const XmlAttribute& time, const World& world) {
  return ticks_of(number(time, 0, a_time), world.dt, time.value_place);
}

// <swap at= instance= plugin= ...>, or with the new plugin as an element inside. In <at> its time is that one's.
SwapDeclaration read_swap(const XmlElement& element, std::optional<uint64_t> of_at, const World& world) {
  const XmlAttribute* own = element.attribute("at");
  if (of_at && own) throw invalid(own->place, "<swap> has no attribute \"at\" inside <at>, whose time it has");
  const uint64_t tick = of_at ? *of_at : tick_of(needed(element, "at", a_time), world);
  const std::string& instance = needed(element, "instance", "the name of an instance").value;
  const XmlElement* inside = element.children.size() == 1 ? &element.children[0] : nullptr;
  const XmlElement& given = inside ? *inside : element;
  if (const auto* name = given.attribute("name"))
    throw invalid(name->place,
                  "<" + given.name + "> has no attribute \"name\"; the replacement keeps the name " + quote(instance));
  if (inside) {
    for (const auto& a : element.attributes) {
      if (a.name != "at" && a.name != "instance") refuse_unknown(a, element.name, {"at", "instance"});
    }
    return {tick, instance, read_instance(*inside, inside->name)};
  }
  XmlElement rest = element;
  std::erase_if(rest.attributes, is_swaps_own);
  InstanceDeclaration replacement =
      read_instance(rest, needed(element, "plugin", "the new plugin's id, or the plugin as an element inside").value);
  replacement.shares_element = true;
  return {tick, instance, std::move(replacement)};
}

RecordDeclaration read_record(const XmlElement& element) {
  RecordDeclaration result{
      needed(element, "table", "a table's name: set/row/quantity, or set/*/quantity for all rows").value, 1,
      element.place};
  for (const auto& given : element.attributes) {
    if (given.name == "every")
      result.every = positive_integer(given);
    else if (given.name != "table")
      refuse_unknown(given, "record", {"table", "every"});
  }
  return result;
}

void warn_of_long_wait(const XmlElement& element, const std::string& outcome, World& world) {
  const XmlAttribute* every = element.attribute("every");
  if (!every || world.ticks == 0 || positive_integer(*every) <= world.ticks) return;
  world.warnings.push_back({every->value_place, "attribute \"every\": " + every->value +
                                                    " ticks are more than the run's " + std::to_string(world.ticks) +
                                                    ", so that <" + element.name + "> " + outcome});
}

void refuse_other_attributes(const XmlElement& element, const std::vector<std::string>& valid) {
  for (const auto& given : element.attributes)
    if (std::find(valid.begin(), valid.end(), given.name) == valid.end()) refuse_unknown(given, element.name, valid);
  if (!element.children.empty() && element.name != "at") refuse_inside(element);
}

// <at t=> with <set path= value=/>, <swap .../> and <leave robot=/> in it.
void read_at(const XmlElement& element, World& world) {
  refuse_other_attributes(element, {"t"});
  const uint64_t tick = tick_of(needed(element, "t", a_time), world);
  if (tick >= world.ticks) world.warnings.push_back({element.place, "<at> comes at the end of the run or after it"});
  if (element.children.empty())
    world.warnings.push_back({element.place, "<at> is empty; expected <set>, <swap> or <leave> in it"});
  for (const XmlElement& child : element.children) {
    if (child.name == "set") {
      refuse_other_attributes(child, {"path", "value"});
      const XmlAttribute& path = needed(child, "path", "a number's path, such as door/d1/state");
      world.changes.push_back({tick, path.value, needed(child, "value", "its new value"), "", path.value_place});
    } else if (child.name == "leave") {
      refuse_other_attributes(child, {"robot"});
      const XmlAttribute& robot = needed(child, "robot", "the name of a robot");
      world.changes.push_back({tick, "", {}, robot.value, robot.value_place});
    } else if (child.name == "swap") {
      world.swaps.push_back(read_swap(child, tick, world));
    } else {
      throw invalid(child.place,
                    "<" + child.name + "> is no element of <at>; " + suggest(child.name, {"set", "swap", "leave"}));
    }
  }
}

// An element with a dot in its name is a plugin; any other must be known.
void read_child(const XmlElement& element, const Standard& standard, World& world) {
  if (element.name == "at") {
    read_at(element, world);
  } else if (element.name == "swap") {
    world.swaps.push_back(read_swap(element, {}, world));
    const auto& swap = world.swaps.back();
    if (swap.tick >= world.ticks)
      world.warnings.push_back(
          {element.place, "the swap of " + quote(swap.instance) + " comes at the end of the run or after it"});
  } else if (element.name == "record") {
    world.records.push_back(read_record(element));
    warn_of_long_wait(element, "is written at its start alone", world);
  } else if (element.name.find('.') != std::string::npos) {
    world.instances.push_back(read_instance(element, element.name));
    warn_of_long_wait(element, "does not step after its start", world);
  } else {
    std::vector<std::string> valid = {"at", "swap", "record"};
    for (const auto& known : standard.elements) {
      if (element.name == known.name) return;  // read_rows() has read it
      valid.push_back(known.name);
    }
    const XmlAttribute* type = element.attribute("type");  // as other simulators name their parts
    throw invalid(element.place, "<" + element.name +
                                     "> is no element of a world; expected a plugin (with a dot in its name" +
                                     (type ? ": <" + element.name + "." + type->value + "/>" : "") + ") or " +
                                     suggest(element.name, valid).substr(9));
  }
}

void check_names(const World& world) {
  std::map<std::string, Place> seen;
  for (const auto& instance : world.instances) {
    const auto [found, is_new] = seen.emplace(instance.name, instance.place);
    if (!is_new) {
      throw invalid(instance.place, "a second instance is called " + quote(instance.name) + "; the first is at " +
                                        found->second.text() + "; give one of them a name=\"...\" of its own");
    }
  }
  for (const auto& swap : world.swaps) {
    if (seen.count(swap.instance)) continue;
    std::vector<std::string> valid;
    for (const auto& [name, place] : seen) valid.push_back(name);
    throw invalid(swap.replacement.place,
                  "no instance is called " + quote(swap.instance) + "; " + suggest(swap.instance, valid));
  }
}

}  // namespace

InstanceDeclaration read_instance(const XmlElement& element, const std::string& plugin) {
  InstanceDeclaration result{plugin, plugin, 1, {}, {}, {}, element.place};
  for (const auto& given : element.attributes) {
    if (given.name == "name") {
      check_name(given);
      result.name = given.value;
    } else if (given.name == "every")
      result.every = positive_integer(given);
    else if (given.name == "library")
      result.library = given.value;
    else if (given.name == "revision")
      result.revision = positive_integer(given);
    else
      result.attributes.push_back(given);
  }
  if (!element.children.empty()) refuse_inside(element);
  return result;
}

uint64_t ticks_of(double time, double dt, const Place& place) {
  if (time < 0) throw invalid(place, print_real(time) + " s is before the start; expected a time from 0");
  const double ticks = std::round(time / dt);
  if (!(ticks < most_ticks))
    throw invalid(place, print_real(time) + " s are " + print_real(ticks) + " ticks of " + print_real(dt) +
                             " s; expected fewer than 1e+12");
  if (time > 0 && time < dt)
    throw invalid(place, print_real(time) + " s are less than a tick of " + print_real(dt) + " s");
  return static_cast<uint64_t>(ticks);
}

World read_world(const std::filesystem::path& path, const Standard& standard) {
  World world;
  world.file = std::filesystem::is_directory(path) ? path / "world.xml" : path;
  const XmlElement root = read_xml(world.file, check_root);
  read_root(root, world);
  read_rows(root, standard, world);
  for (const auto& child : root.children) read_child(child, standard, world);
  check_names(world);
  return world;
}

}  // namespace muster
