#include "ladder.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "run_options.hpp"
#include "text/error.hpp"

namespace muster::cli {
namespace {

constexpr const char* who = "muster compare --ladder";
using Names = std::vector<std::string>;

void set(InstanceDeclaration& instance, const std::string& name, const std::string& value) {
  const auto found = std::find_if(instance.attributes.begin(), instance.attributes.end(),
                                  [&](const XmlAttribute& a) { return a.name == name; });
  if (found != instance.attributes.end())
    found->value = value;
  else
    instance.attributes.push_back({name, value, {who}, {who}});
}

bool has(const Names& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool claims(const Instance& instance, uint32_t kind, const std::string& table) {
  const auto& all = instance.claims();
  return std::any_of(all.begin(), all.end(),
                     [&](const Claim& claim) { return claim.kind == kind && claim.name.logical() == table; });
}

bool has_model(const muster_plugin& plugin, const std::string& model) {
  return std::any_of(plugin.params, plugin.params + plugin.param_count, [&](const muster_param& param) {
    return param.kind == MUSTER_CHOICE && std::string("model") == param.name &&
           ('|' + std::string(param.text) + '|').find('|' + model + '|') != std::string::npos;
  });
}

// What the instances of a world are to its channel, by what they claim and which parameters they have: their names.
struct Channel {
  std::string path_loss;  // with a parameter `model`
  Names shadows;          // terms with a parameter `shadowing`, which is none at 0
  Names fades;            // what writes the fading, and has a flag for it
  Names fades_always;     // what else makes it
  Names other_terms;      // of the level
  std::string network;    // carries messages

  bool has_fading() const { return !fades.empty() || !fades_always.empty(); }
};

Channel channel_of(const Simulation& given) {
  Channel result;
  for (const auto& each : given.instances()) {
    const bool adds = claims(*each, MUSTER_ADD, "link/*/level"), shadows = each->find_param("shadowing") >= 0;
    const bool fades = claims(*each, MUSTER_WRITE, "link/*/fading") || claims(*each, MUSTER_MODIFY, "link/*/fading");
    if (fades) (each->find_param("fading") >= 0 ? result.fades : result.fades_always).push_back(each->name());
    if (adds && has_model(each->plugin(), "perfect"))
      result.path_loss = each->name();
    else if (adds && (shadows || !fades))
      (shadows ? result.shadows : result.other_terms).push_back(each->name());
    if (claims(*each, MUSTER_WRITE, "inbox/*/message")) result.network = each->name();
  }
  return result;
}

void remove(World& world, const Names& names) {
  const auto gone = [&](const std::string& name) { return has(names, name); };
  std::erase_if(world.instances, [&](const InstanceDeclaration& each) { return gone(each.name); });
  for (Occasion& occasion : world.occasions) {
    std::erase_if(occasion.plugins, [&](const PluginChange& each) { return gone(each.instance); });
    std::erase_if(occasion.rows,
                  [&](const RowChange& each) { return gone(each.path.substr(0, each.path.rfind('/'))); });
  }
}

InstanceDeclaration* find(World& world, const std::string& name) {
  const auto found = std::find_if(world.instances.begin(), world.instances.end(),
                                  [&](const InstanceDeclaration& each) { return each.name == name; });
  return found == world.instances.end() ? nullptr : &*found;
}

// Of instances that the world has, their plugins.
std::string plugins_of(World world, const Names& names) {
  Names result;
  for (const std::string& name : names) result.push_back(find(world, name)->plugin);
  return fmt::format("{}", fmt::join(result, ", "));
}

// Where nothing of the world's own shadows or fades, radio.fading does.
void set_fading(World& world, const Channel& channel, bool shadowing, bool fading) {
  for (InstanceDeclaration& each : world.instances) {
    if (!shadowing && has(channel.shadows, each.name)) set(each, "shadowing", "0");
    if (has(channel.fades, each.name)) set(each, "fading", fading ? "true" : "false");
  }
  if (!fading) remove(world, channel.fades_always);
  if (channel.has_fading() || (channel.shadows.empty() ? !shadowing : !fading)) return;
  auto own = instance_of("radio.fading", "radio.fading", {}, who);
  if (!channel.shadows.empty()) set(own, "shadowing", "0");
  set(own, "fading", fading ? "true" : "false");
  world.instances.push_back(std::move(own));
}

// What carries messages is of `plugin`; where that changes, without attributes.
void set_network(World& world, const Channel& channel, const std::string& plugin) {
  InstanceDeclaration* const network = find(world, channel.network);
  if (network == nullptr) {
    world.instances.push_back(instance_of(plugin, plugin, {}, who));
  } else if (network->plugin != plugin) {
    auto made = instance_of(network->name, plugin, {}, who);
    made.every = network->every;
    *network = std::move(made);
  }
}

}  // namespace

std::vector<Rung> ladder(const World& world, const Simulation& given) {
  const Channel channel = channel_of(given);
  World ideal = world;
  if (!find(ideal, channel.path_loss)) return {};
  const bool talks = !channel.network.empty();
  std::string shared = "network.lrwpan";
  if (const auto* own = find(ideal, channel.network); own && own->plugin != "network.ideal") shared = own->plugin;
  if (talks) set_network(ideal, channel, "network.ideal");

  std::vector<Rung> result;
  const auto put = [&](const std::string& name, const std::string& change, World rung, const std::string& model,
                       bool shadowing, bool fading) {
    set(*find(rung, channel.path_loss), "model", model);
    set_fading(rung, channel, shadowing, fading);
    result.push_back({name, change, std::move(rung)});
  };
  World plain = ideal;
  remove(plain, channel.other_terms);
  const std::string path_loss = plugins_of(world, {channel.path_loss});
  for (const std::string model : {"perfect", "disc", "log_distance", "multi_wall"})
    put(model, path_loss + " model=\"" + model + '"', plain, model, false, false);
  const auto plugins = [&](const Names& own) { return own.empty() ? "radio.fading" : plugins_of(world, own); };
  if (!channel.other_terms.empty())
    put("+ other terms", plugins(channel.other_terms), ideal, "multi_wall", false, false);
  if (!channel.shadows.empty() || !channel.has_fading())
    put("+ shadowing", plugins(channel.shadows) + " shadowing", ideal, "multi_wall", true, false);
  put("+ fading", plugins(channel.fades.empty() ? channel.fades_always : channel.fades) + " fading=\"true\"", ideal,
      "multi_wall", true, true);
  if (!talks) return result;
  World contended = world;
  set_network(contended, channel, shared);
  put("+ contention", shared, std::move(contended), "multi_wall", true, true);
  return result;
}

std::vector<Rung> ladder_of_bodies(const World& world, const Simulation& given, const std::filesystem::path& log) {
  std::string physics;
  for (const auto& each : given.instances()) {
    if (claims(*each, MUSTER_WRITE, "robot/*/pose")) physics = each->name();
  }
  World own = world;
  if (!find(own, physics)) return {};
  std::vector<Rung> result;
  const auto put = [&](const std::string& name, const std::string& plugin, const std::string& attribute,
                       const std::string& value) {
    World rung = world;
    InstanceDeclaration& body = *find(rung, physics);
    if (body.plugin != plugin) {
      auto made = instance_of(physics, plugin, {}, who);
      made.every = body.every;
      body = std::move(made);
    }
    set(body, attribute, value);
    result.push_back({name, plugin + ' ' + attribute + "=\"" + value + '"', std::move(rung)});
  };
  put("kinematic", "physics.planar", "through_walls", "true");
  put("rolling", "physics.simbody", "integrator", "rk3");
  put("slipping", "physics.simbody", "integrator", "midpoint");
  if (!log.empty()) put("measured", "physics.replay", "file", std::filesystem::absolute(log).string());
  return result;
}

}  // namespace muster::cli
