#include "idle_doubts.hpp"

#include <algorithm>

#include "text/names.hpp"
#include "text/number.hpp"
#include "world_file/params.hpp"

namespace muster::cli {
namespace {

// Rows that the world file lists, those that join later among them; radios are stations and robots.
struct Listed {
  std::size_t robots = 0, radios = 0, walls = 0;
  bool is_whole = true;  // false: a plugin lets more of them join
};

Listed listed_in(const Simulation& run) {
  Listed result;
  for (const RowDeclaration& row : run.world().rows) {
    result.robots += row.set == "robot";
    result.radios += std::find(row.sets.begin(), row.sets.end(), "radio") != row.sets.end();
    result.walls += row.set == "wall";
  }
  for (const auto& instance : run.instances())
    for (const Claim& claim : instance->claims())
      if (claim.kind == MUSTER_WRITE && (claim.flags & MUSTER_JOINS)) result.is_whole = false;
  return result;
}

bool is_plugin(const Instance& instance, const std::string& wanted) {
  const std::string id = instance.plugin().id;
  return id.substr(0, id.find('/')) == wanted;
}

std::string named(const Instance& instance) { return instance.place().text() + ": " + instance.declared().plugin; }

// The value of a choice, as the world file writes it; "" where there is no such parameter.
std::string choice_of(const Instance& instance, const std::string& name) {
  const int at = instance.find_param(name);
  if (at < 0 || instance.plugin().params[at].kind != MUSTER_CHOICE) return "";
  return value_text(instance.plugin().params[at], instance.params()[static_cast<std::size_t>(at)]);
}

// Of sensors.range: to whom it measures, and there is none.
std::string without_peers(const Instance& instance, const Listed& listed) {
  if (instance.declared().attribute("peers")) return "";
  const std::string to = choice_of(instance, "to");
  const std::size_t stations = listed.radios - listed.robots;
  const std::size_t peers = to == "stations" ? stations : to == "robots" ? listed.robots - 1 : listed.radios - 1;
  if (listed.robots == 0 || peers > 0) return "";
  return named(instance) + " measures to " +
         (to == "all"      ? "other radios"
          : to == "robots" ? "other robots"
                           : to) +
         ", and the world has none, so that range/*/message stays empty; expected a " +
         (to == "stations" ? "<station>" + std::string(listed.robots > 1 ? ", or to=\"robots\"" : "")
                           : "second <robot>" + std::string(to == "all" ? " or a <station>" : ""));
}

// Attributes `at` and `start` in seconds of what then never begins.
std::string too_late(const Instance& instance, double until) {
  for (const XmlAttribute& given : instance.declared().attributes) {
    const int at = instance.find_param(given.name);
    if ((given.name != "at" && given.name != "start") || at < 0) continue;
    const double value = instance.params()[static_cast<std::size_t>(at)];
    if (std::string(instance.plugin().params[at].unit) != "s" || !(value >= until)) continue;
    return given.value_place.text() + ": attribute " + quote(given.name) + ": " + print_real(value) +
           " s, and the run ends at " + print_real(until) + " s, so that <" + instance.declared().plugin +
           "> never acts; expected a time below " + print_real(until) + " s, or a longer run (until)";
  }
  return "";
}

}  // namespace

std::vector<std::string> idle_doubts(const Simulation& run) {
  std::vector<std::string> result;
  const Listed listed = listed_in(run);
  const double until = run.world().until();
  const auto& all = run.instances();
  // Where nobody drives or sends, a world is of measured data, whose times its own length does not bound.
  const bool is_run =
      std::any_of(all.begin(), all.end(), [](const auto& each) { return each->phase() == MUSTER_CONTROL; });
  for (const auto& each : all) {
    const Instance& instance = *each;
    std::string doubt;
    if (is_plugin(instance, "radio.images") && listed.walls == 0)
      doubt = named(instance) +
              " is of walls that reflect, and the world has none, so that it has no effect; expected a "
              "<wall>, or no <radio.images>";
    if (listed.is_whole && is_plugin(instance, "radio.bodies") && listed.radios < 3)
      doubt = named(instance) + " is of robots between two others, and the world has " +
              (listed.radios == 1 ? "one radio" : "two radios") +
              ", so that it has no effect; expected a third radio or robot, or no <radio.bodies>";
    if (listed.is_whole && is_plugin(instance, "sensors.range")) doubt = without_peers(instance, listed);
    if (until > 0 && is_run && doubt.empty()) doubt = too_late(instance, until);
    if (!doubt.empty()) result.push_back(doubt);
  }
  return result;
}

std::vector<std::string> idle_notes(const Simulation& run) {
  std::vector<std::string> result;
  const Listed listed = listed_in(run);
  for (const auto& each : run.instances()) {
    const Instance& instance = *each;
    const std::string model = choice_of(instance, "model");
    if (listed.walls > 0 && is_plugin(instance, "radio.multiwall") && model != "multi_wall")
      result.push_back(instance.place().text() + ": model=" + quote(model) + " counts no walls, so that the world's (" +
                       std::to_string(listed.walls) + ") cost links nothing; model=\"multi_wall\" counts them");
    const InstanceDeclaration& declared = instance.declared();
    if (is_plugin(instance, "sensors.gps") && !declared.attribute("latitude") && !declared.attribute("longitude"))
      result.push_back(named(instance) +
                       " has neither latitude nor longitude, so that the world's origin is at 0 N 0 E, in "
                       "the Atlantic; expected both, in degrees, where the place counts");
  }
  return result;
}

}  // namespace muster::cli
