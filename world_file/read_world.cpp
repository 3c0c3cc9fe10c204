// A world file as a whole.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "doubts.hpp"
#include "occasions.hpp"
#include "params.hpp"
#include "rows.hpp"
#include "text/names.hpp"
#include "text/number.hpp"
#include "text/synonyms.hpp"
#include "text/xml_scan.hpp"

namespace muster {
namespace {

// Refuses a file of another kind at its first element: what follows in it would give misleading errors.
void check_root(const std::string& name, const Place& place) {
  if (name == "world") return;
  static const std::map<std::string, std::string> others = {
      {"sdf", ", as in a file of Gazebo; muster reads no SDF: expected <world>, with walls, stations and robots in it"},
      {"gazebo", ", as in a file of Gazebo; muster reads no SDF: expected <world>"},
      {"robot",
       ", as in a robot's description; expected <world>, with <robot model=\"FILE.urdf\" at=\"0 0 0\"/> in it"},
      {"launch", ", as in a launch file of ROS; expected <world>"},
      {"mujoco", ", as in a model of MuJoCo; expected <world>"}};
  const auto other = others.find(name);
  throw invalid(place,
                "the root element is <" + name + ">" + (other == others.end() ? "; expected <world>" : other->second));
}

const std::string plan_of_a_file =
    "; expected the elements themselves, or <walls file=\"walls.csv\"/>, a table name,x0[m],y0[m],x1[m],y1[m],material";

void read_root(const XmlElement& root, World& world) {
  static const std::vector<std::string> valid = {"name", "dt", "until", "seed"};
  world.name = std::filesystem::absolute(world.file).lexically_normal().parent_path().filename().string();
  const XmlAttribute* until = nullptr;
  for (const auto& given : root.attributes) {
    if (given.name == "name")
      world.name = given.value;
    else if (given.name == "dt")
      world.dt = real_of(given, 1e-9, "the tick in seconds, from 1e-09");
    else if (given.name == "until")
      until = &given;
    else if (given.name == "seed") {
      const auto seed = parse_integer(given.value);
      if (!seed || *seed < 0)
        throw invalid(given.value_place, "attribute \"seed\": " +
                                             (seed ? given.value + " is out of bounds" : why_not_integer(given.value)) +
                                             "; expected an integer from 0");
      world.seed = static_cast<uint64_t>(*seed);
    } else if (given.name.starts_with("xmlns")) {
      throw invalid(given.place, "a world has no namespaces (" + given.name + ")" +
                                     (given.value.find("XInclude") == given.value.npos
                                          ? "; expected <world> without it"
                                          : ", and includes no files: it is one file" + plan_of_a_file));
    } else {
      refuse_unknown(given, "world", valid);
    }
  }
  if (!until) throw lacking(root, "until", "the end of the run in seconds, from 0");
  world.ticks = ticks_of(real_of(*until, 0, "the end of the run in seconds, from 0"), world.dt, until->value_place);
}

RecordDeclaration read_record(const XmlElement& element, double dt) {
  RecordDeclaration result{
      needed(element, "table", "a table's name: set/row/quantity, or set/*/quantity for all rows").value, 1,
      element.place};
  for (const auto& given : element.attributes) {
    if (given.name == "every")
      result.every = ticks_in(given, dt);
    else if (given.name != "table")
      refuse_unknown(given, "record", {"table", "every"});
  }
  if (!element.children.empty()) refuse_inside(element);
  return result;
}

void warn_of_long_wait(const XmlElement& element, const std::string& outcome, World& world) {
  const XmlAttribute* every = element.attribute("every");
  if (!every || world.ticks == 0 || positive_integer(*every) <= world.ticks) return;
  world.warnings.push_back({every->value_place, "attribute \"every\": " + every->value +
                                                    " ticks are more than the run's " + std::to_string(world.ticks) +
                                                    ", so that <" + element.name + "> " + outcome});
}

// Of two records of one table the first alone is written.
void warn_of_second_record(const XmlElement& element, World& world) {
  const RecordDeclaration& made = world.records.back();
  const auto first = std::find_if(world.records.begin(), world.records.end(),
                                  [&](const RecordDeclaration& each) { return each.table == made.table; });
  if (first == world.records.end() - 1) return;
  world.warnings.push_back({element.place, "<record> of " + quote(made.table) + " stands twice, and the first (" +
                                               first->place.text() + ") alone is written, every " +
                                               std::to_string(first->every) + (first->every == 1 ? " tick" : " ticks") +
                                               "; expected one of the two"});
}

// The model that is like that of Gazebo in a text such as "model://turtlebot3_waffle"; "..." where none is known.
std::string model_meant_by(std::string_view text) {
  static const std::vector<std::string> likely = {"waffle", "husky", "scarab", "hummingbird", "f1tenth", "youbot"};
  for (std::size_t from = 0, to = 0; from < text.size(); from = to + 1) {
    to = std::min(text.find_first_of("/:_-. ", from), text.size());
    std::string word(text.substr(from, to - from));
    if (std::find(likely.begin(), likely.end(), word) != likely.end()) return word;
  }
  for (std::size_t from = 0, to = 0; from < text.size(); from = to + 1) {
    to = std::min(text.find_first_of("/:_-. ", from), text.size());
    if (std::string like = synonym(text.substr(from, to - from), likely); !like.empty()) return like;
  }
  return "...";
}

// What to do without an element of SDF that has no like here; `text` is one in it, where it is known.
std::string foreign_element(const std::string& name, std::string_view text = "") {
  if (name == "plugin")
    return "; a plugin is an element of its own name, such as <physics.simbody/>, and what a robot's model has, as its "
           "drive and its laser, needs none: leave it out";
  if (name == "include")
    return ", which is one file and takes no models of Gazebo; expected <robot name=\"...\" model=\"" +
           model_meant_by(text) + "\" at=\"0 0 0\"/>, a model of muster or a URDF file";
  if (name == "xi:include") return ", which is one file and includes no others" + plan_of_a_file;
  if (name == "light" || name == "scene" || name == "gui") return "; leave it out";
  if (name == "physics" || name == "gravity") return "; the physics is a plugin, such as <physics.simbody/>";
  if (name == "node")
    return "; a node is a plugin, such as <control.waypoint robot=\"...\"/>: muster plugins lists them";
  return "";
}

// The plugin that an element of another simulator is here, such as <physics type="ode"> and <sensor type="imu">.
std::string as_plugin(const std::string& name, std::string_view type) {
  static const std::map<std::string, std::string> kinds = {{"physics", "physics"},
                                                           {"sensor", "sensors"},
                                                           {"radio", "radio"},
                                                           {"network", "network"},
                                                           {"controller", "control"}};
  const auto kind = kinds.find(name);
  return !type.empty() && kind != kinds.end() ? kind->second + '.' + std::string(type) : "";
}

// The value of `type` in a start tag.
std::string_view type_in(std::string_view tag) {
  constexpr std::string_view key = " type=\"";
  const auto from = tag.find(key);
  if (from == tag.npos) return "";
  tag.remove_prefix(from + key.size());
  return tag.substr(0, tag.find('"'));
}

bool is_element(const Standard& standard, std::string_view name) {
  return name == "at" || name == "swap" || name == "record" || name.find('.') != name.npos ||
         std::any_of(standard.elements.begin(), standard.elements.end(),
                     [&](const auto& known) { return name == known.name; });
}

// Numbers in an element as its attributes: at="2 1 1.5" of <station>2 1 1.5</station>; "" where it has none of so many.
std::string as_attributes(const Element& element, std::string_view text) {
  std::istringstream words{std::string(text)};
  std::vector<std::string> numbers;
  for (std::string word; words >> word; numbers.push_back(word))
    if (!parse_real(word)) return "";
  std::string result;
  std::size_t taken = 0;
  for (const Attribute& attribute : element.attributes) {
    const auto count = static_cast<std::size_t>(attribute.count);
    const bool is_number = attribute.param.kind == MUSTER_REAL && (attribute.param.flags & MUSTER_REQUIRED);
    if (!is_number || taken + count > numbers.size()) continue;
    result += (result.empty() ? "" : " ") + std::string(attribute.param.name) + "=\"";
    for (std::size_t i = 0; i < count; ++i) result += (i > 0 ? " " : "") + numbers[taken++];
    result += '"';
  }
  return !numbers.empty() && taken == numbers.size() ? result : "";
}

// SDF's <pose>x y z roll pitch yaw</pose>. A text in an element that a world has not is that element's fault, and told
// at its place: throws FaultOfElement.
std::string in_place_of_text(const Standard& standard, const std::vector<std::string_view>& open,
                             std::string_view text) {
  const auto name_at = [&](std::size_t depth) { return open[depth].substr(0, open[depth].find_first_of(" \t\r\n/")); };
  for (const Element& known : standard.elements) {
    const std::string given = open.size() == 2 && name_at(1) == known.name ? as_attributes(known, text) : "";
    if (!given.empty()) return "expected it as an attribute: <" + std::string(known.name) + ' ' + given + "/>";
  }
  if (open.size() < 3) return "";
  const std::string_view own = name_at(open.size() - 1), around = name_at(open.size() - 2);
  if (const std::string outer(name_at(1)); !is_element(standard, outer)) {
    const std::string plugin = as_plugin(outer, type_in(open[1]));
    throw FaultOfElement{1, "<" + outer + "> is no element of a world" +
                                (plugin.empty() ? foreign_element(outer, text) : "; expected <" + plugin + "/>")};
  }
  const auto numbers = parse_reals(text, 6);
  if (own != "pose" || !numbers) return "";
  const auto list = [&](std::size_t from, std::size_t to) {
    std::string result;
    for (std::size_t i = from; i < to; ++i) result += (i > from ? " " : "") + print_real((*numbers)[i]);
    return result;
  };
  return "expected attributes: <" + std::string(around) + " at=\"" + list(0, 3) + "\"" +
         (around == "robot" ? " heading=\"" + list(5, 6) + '"' : "") + "/>";
}

// An element with a dot in its name is a plugin; any other must be known.
void read_child(const XmlElement& element, const Standard& standard, World& world) {
  if (element.name == "at") {
    read_at(element, standard, world);
  } else if (element.name == "swap") {
    read_swap_element(element, world);
  } else if (element.name == "record") {
    world.records.push_back(read_record(element, world.dt));
    warn_of_long_wait(element, "is written at its start alone", world);
    warn_of_second_record(element, world);
  } else if (element.name.find('.') != std::string::npos) {
    world.instances.push_back(read_instance(element, element.name));
    warn_of_long_wait(element, "does not step after its start", world);
  } else {
    std::vector<std::string> valid = {"at", "swap", "record"};
    for (const auto& known : standard.elements) {
      if (element.name == known.name) return;  // read_rows() has read it
      valid.push_back(known.name);
    }
    const XmlAttribute* type = element.attribute("type");
    const std::string plugin = as_plugin(element.name, type ? type->value : ""),
                      foreign = foreign_element(element.name);
    throw invalid(element.place,
                  "<" + element.name + "> is no element of a world; expected a plugin (with a dot in its name" +
                      (plugin.empty() ? "" : ": <" + plugin + "/>") + ") or " + expected_one_of(valid).substr(9) +
                      (!plugin.empty()    ? ""
                       : !foreign.empty() ? foreign
                                          : did_you_mean(element.name, valid)));
  }
}

void check_names(World& world) {
  std::map<std::string, Place> seen;
  for (const auto& instance : world.instances) {
    const auto [found, is_new] = seen.emplace(instance.name, instance.place);
    if (!is_new) {
      throw invalid(instance.place, "a second instance is called " + quote(instance.name) + "; the first is at " +
                                        found->second.text() + "; give one of them a name=\"...\" of its own");
    }
  }
  check_occasions(world);
  warn_of_vain_changes(world);
}

}  // namespace

World read_world(const std::filesystem::path& path, const Standard& standard) {
  World world;
  world.file = std::filesystem::is_directory(path) ? path / "world.xml" : path;
  const XmlElement root = read_xml(world.file, check_root,
                                   [&](const auto& open, auto text) { return in_place_of_text(standard, open, text); });
  read_root(root, world);
  read_rows(root, standard, world);
  for (const auto& child : root.children) read_child(child, standard, world);
  check_names(world);
  look_for_doubts(root, world);
  return world;
}

}  // namespace muster
