#include "ladder.hpp"

#include <algorithm>

#include "text/error.hpp"
#include "world_words.hpp"

namespace muster::cli {
namespace {

constexpr const char* who = "muster compare --ladder";

void set(InstanceDeclaration& instance, const std::string& name, const std::string& value) {
  const auto found = std::find_if(instance.attributes.begin(), instance.attributes.end(),
                                  [&](const XmlAttribute& a) { return a.name == name; });
  if (found != instance.attributes.end())
    found->value = value;
  else
    instance.attributes.push_back({name, value, {who}, {who}});
}

InstanceDeclaration* find(World& world, const std::string& plugin) {
  const auto found = std::find_if(world.instances.begin(), world.instances.end(),
                                  [&](const InstanceDeclaration& i) { return i.plugin == plugin; });
  return found == world.instances.end() ? nullptr : &*found;
}

bool is_network(const std::string& plugin) { return plugin.starts_with("network."); }

// The instance that carries messages is of `plugin`; where that changes, without attributes.
void set_network(World& world, const std::string& plugin) {
  for (InstanceDeclaration& each : world.instances) {
    if (!is_network(each.plugin) || each.plugin == plugin) continue;
    auto made = instance_of(each.name, plugin, {}, who);
    made.every = each.every;
    each = std::move(made);
    return;
  }
  if (!find(world, plugin)) world.instances.push_back(instance_of(plugin, plugin, {}, who));
}

// With neither, the plugin need not be there.
void set_fading(World& world, bool shadowing, bool fading) {
  InstanceDeclaration* instance = find(world, "radio.fading");
  if (!instance && !shadowing) return;
  if (!instance) {
    world.instances.push_back(instance_of("radio.fading", "radio.fading", {}, who));
    instance = &world.instances.back();
  }
  if (!shadowing) set(*instance, "shadowing", "0");
  set(*instance, "fading", fading ? "true" : "false");
}

}  // namespace

std::vector<Rung> ladder(const World& world, const Simulation& given) {
  World lowest = world;
  if (!find(lowest, "radio.multiwall"))
    throw Error(Exit::invalid_input, std::string(who) +
                                         ": no instance of the world is a radio.multiwall, whose model the "
                                         "first rungs set");
  std::string shared = "network.lrwpan";
  bool talks = false;
  for (const auto& instance : given.instances()) talks |= is_network(instance->plugin().id);
  for (const auto& each : world.instances) {
    if (is_network(each.plugin) && each.plugin != "network.ideal") shared = each.plugin;
  }
  if (talks) set_network(lowest, "network.ideal");

  std::vector<Rung> result;
  for (const std::string model : {"perfect", "disc", "log_distance", "multi_wall"}) {
    World rung = lowest;
    set(*find(rung, "radio.multiwall"), "model", model);
    set_fading(rung, false, false);
    result.push_back({model, "radio.multiwall model=\"" + model + '"', std::move(rung)});
  }
  set_fading(lowest, true, false);
  set(*find(lowest, "radio.multiwall"), "model", "multi_wall");
  result.push_back({"+ shadowing", "radio.fading shadowing", lowest});
  set_fading(lowest, true, true);
  result.push_back({"+ fading", "radio.fading fading=\"true\"", lowest});
  if (!talks) return result;
  lowest = world;
  set(*find(lowest, "radio.multiwall"), "model", "multi_wall");
  set_fading(lowest, true, true);
  set_network(lowest, shared);
  result.push_back({"+ contention", shared, std::move(lowest)});
  return result;
}

}  // namespace muster::cli
