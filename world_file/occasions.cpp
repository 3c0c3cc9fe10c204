#include "occasions.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "kinds.hpp"
#include "params.hpp"
#include "text/names.hpp"
#include "text/number.hpp"

namespace muster {
namespace {

const std::vector<std::string> of_at = {"set", "leave", "robot", "station", "swap", "remove"};
constexpr const char* a_time = "a time in seconds, from 0";
constexpr const char* a_condition =
    "a condition, TABLE/COLUMN below, above or is NUMBER, such as \"robot/leader/pose/x above 3\" or "
    "\"link/base/rover/rssi/rssi below -60\"";

uint64_t tick_of(const XmlAttribute& time, const World& world) {
  return ticks_of(real_of(time, 0, a_time), world.dt, time.value_place);
}

bool is_swaps_own(const XmlAttribute& given) {
  return std::find(swap_attributes.begin(), swap_attributes.end(), given.name) != swap_attributes.end();
}

// The new plugin, as attributes of <swap> or as an element inside.
PluginChange read_swap(const XmlElement& element) {
  const XmlAttribute& named = needed(element, "instance", "the name of an instance");
  const std::string& instance = named.value;
  const XmlElement* inside = element.children.size() == 1 ? &element.children[0] : nullptr;
  const XmlElement& given = inside ? *inside : element;
  if (const auto* name = given.attribute("name"))
    throw invalid(name->place,
                  "<" + given.name + "> has no attribute \"name\"; the replacement keeps the name " + quote(instance));
  if (inside) {
    for (const auto& a : element.attributes) {
      if (a.name != "at" && a.name != "instance") refuse_unknown(a, element.name, {"at", "instance"});
    }
    return {PluginChange::Kind::swap, instance, read_instance(*inside, inside->name), inside->place, named.value_place};
  }
  XmlElement rest = element;
  std::erase_if(rest.attributes, is_swaps_own);
  InstanceDeclaration replacement =
      read_instance(rest, needed(element, "plugin", "the new plugin's id, or the plugin as an element inside").value);
  replacement.shares_element = true;
  return {PluginChange::Kind::swap, instance, std::move(replacement), element.place, named.value_place};
}

Condition read_condition(const XmlAttribute& given) {
  const auto refuse = [&](const std::string& what) -> Error {
    return invalid(given.value_place, "attribute \"when\": " + what);
  };
  std::vector<std::string> words(1);
  for (const char c : given.value) {
    if (c != ' ')
      words.back() += c;
    else if (!words.back().empty())
      words.emplace_back();
  }
  if (words.back().empty()) words.pop_back();
  const bool is_joined =
      std::any_of(words.begin(), words.end(), [](const std::string& word) { return word == "and" || word == "or"; });
  if (words.size() == 4 && parse_real(words[2]))  // "below -60 dBm"
    throw refuse(why_not_real(words[2] + ' ' + words[3]) + "; expected a number to compare with");
  if (words.size() != 3)
    throw refuse(quote(given.value) + " is no condition; expected " + a_condition +
                 (is_joined ? "; one comparison in each: \"and\" and \"or\" are not known" : ""));
  static const std::vector<std::string> relations = {"below", "above", "is"};
  const auto relation = std::find(relations.begin(), relations.end(), words[1]);
  if (relation == relations.end())
    throw refuse(quote(words[1]) + " compares no numbers; " + suggest(words[1], relations));
  const auto value = parse_real(words[2]);
  if (!value) throw refuse(why_not_real(words[2]) + "; expected a number to compare with");
  return {given.value, words[0], static_cast<Condition::Relation>(relation - relations.begin()), *value,
          given.value_place};
}

Occasion read_occasion(const XmlElement& element, const World& world) {
  for (const auto& given : element.attributes) {
    if (given.name != "t" && given.name != "when") refuse_unknown(given, element.name, {"t", "when"});
  }
  Occasion occasion;
  occasion.place = element.place;
  const XmlAttribute *t = element.attribute("t"), *when = element.attribute("when");
  if (t && when) throw invalid(when->place, "<at> has t=\"...\" and when=\"...\"; expected one of them");
  if (when) {
    occasion.when = read_condition(*when);
    return occasion;
  }
  occasion.tick = tick_of(needed(element, "t", "a time in seconds, from 0, or when=\"...\", a condition"), world);
  return occasion;
}

RowChange joining(const XmlElement& element, const World& world) {
  const Place& at = element.place;
  const auto row = std::find_if(world.rows.begin(), world.rows.end(), [&](const RowDeclaration& each) {
    return each.place.file == at.file && each.place.line == at.line && each.place.column == at.column;
  });
  return {RowChange::Kind::join, "", {}, row->name, row->sets, element.place};
}

}  // namespace

void read_at(const XmlElement& element, const Standard& standard, World& world) {
  Occasion occasion = read_occasion(element, world);
  if (element.children.empty()) {
    std::string elements;
    for (const auto& name : of_at) elements += (elements.empty() ? "<" : ", <") + name + ">";
    world.warnings.push_back({element.place, "<at> is empty; expected " + elements + " or a plugin in it"});
  }
  for (const XmlElement& child : element.children) {
    const bool is_standard = std::any_of(standard.elements.begin(), standard.elements.end(),
                                         [&](const Element& each) { return child.name == each.name; });
    if (child.name == "set") {
      expect_attributes(child, {"path", "value"});
      const XmlAttribute& path = needed(child, "path", "a number's path, such as door/d1/state");
      occasion.rows.push_back(
          {RowChange::Kind::set, path.value, needed(child, "value", "its new value"), "", {}, path.value_place});
    } else if (child.name == "leave") {
      expect_attributes(child, {"robot", "station"});
      const XmlAttribute* station = child.attribute("station");
      const XmlAttribute& who = station ? *station : needed(child, "robot", "the name of a robot, or station=\"...\"");
      if (station && child.attribute("robot"))
        throw invalid(station->place, "<leave> has robot=\"...\" and station=\"...\"; expected one of them");
      std::vector<std::string> sets{"radio"};
      if (!station) sets.insert(sets.begin(), "robot");
      occasion.rows.push_back({RowChange::Kind::leave, "", {}, who.value, sets, who.value_place});
    } else if (child.name == "swap") {
      if (const XmlAttribute* own = child.attribute("at"))
        throw invalid(own->place, "<swap> has no attribute \"at\" inside <at>, whose time it has");
      occasion.plugins.push_back(read_swap(child));
    } else if (child.name == "remove") {
      for (const char* row : {"robot", "station"})
        if (const XmlAttribute* who = child.attribute(row))
          throw invalid(who->place, std::string("<remove> takes a plugin out, by instance=\"...\"; a ") + row +
                                        " leaves by <leave " + row + "=\"" + who->value + "\"/>");
      expect_attributes(child, {"instance"});
      const XmlAttribute& instance = needed(child, "instance", "the name of an instance");
      occasion.plugins.push_back(
          {PluginChange::Kind::remove, instance.value, {}, instance.value_place, instance.value_place});
    } else if (child.name.find('.') != std::string::npos) {
      InstanceDeclaration made = read_instance(child, child.name);
      const std::string name = made.name;
      occasion.plugins.push_back({PluginChange::Kind::insert, name, std::move(made), child.place});
    } else if (is_standard) {
      occasion.rows.push_back(joining(child, world));  // of a live set: read_rows() has refused others
    } else {
      throw invalid(child.place, "<" + child.name + "> is no element of <at>; expected a plugin (with a dot in its " +
                                     "name) or " + expected_one_of(of_at).substr(9) + did_you_mean(child.name, of_at));
    }
  }
  world.occasions.push_back(std::move(occasion));
}

void read_swap_element(const XmlElement& element, World& world) {
  Occasion occasion;
  occasion.tick = tick_of(needed(element, "at", a_time), world);
  occasion.place = element.place;
  occasion.plugins.push_back(read_swap(element));
  occasion.title = "the swap of " + quote(occasion.plugins[0].instance);
  world.occasions.push_back(std::move(occasion));
}

void check_occasions(const World& world) {
  std::map<std::string, Place> first;  // of each name
  for (const auto& instance : world.instances) first.emplace(instance.name, instance.place);
  for (const auto& occasion : world.occasions) {
    for (const auto& change : occasion.plugins) {
      if (change.kind != PluginChange::Kind::insert) continue;
      const auto [found, is_new] = first.emplace(change.instance, change.place);
      if (!is_new)
        throw invalid(change.place, "a second instance is called " + quote(change.instance) + "; the first is at " +
                                        found->second.text() + "; give one of them a name=\"...\" of its own");
    }
  }
  std::vector<std::string> valid;
  for (const auto& [name, place] : first) valid.push_back(name);
  for (const auto& occasion : world.occasions) {
    for (const auto& change : occasion.plugins) {
      if (first.count(change.instance)) continue;
      const std::string owner = whose_plugin(world.instances, change.instance);
      throw invalid(
          change.instance_place,
          "no instance is called " + quote(change.instance) + which_is(world, change.instance, "instance") +
              (owner.empty() ? "; " + suggest(change.instance, valid)
                             : ", which is the plugin of " + quote(owner) + "; expected instance=\"" + owner + '"'));
    }
  }
}

void warn_of_vain_changes(World& world) {
  std::map<std::pair<uint64_t, std::string>, Place> first_set;  // by tick and path
  for (const Occasion& occasion : world.occasions) {
    for (const RowChange& change : occasion.rows) {
      if (occasion.when || change.kind != RowChange::Kind::set) continue;
      const auto [first, is_new] = first_set.insert({{occasion.tick, change.path}, change.place});
      if (is_new) continue;
      const std::string time = print_real(static_cast<double>(occasion.tick) * world.dt) + " s";
      world.warnings.push_back({change.place, quote(change.path) + " is set twice at " + time + "; the first is at " +
                                                  first->second.text() + ", and the last one counts"});
    }
  }
}

}  // namespace muster
