#include "exchange.hpp"

#include <algorithm>
#include <sstream>

#include "run_options.hpp"
#include "text/names.hpp"
#include "world_file/kinds.hpp"

namespace muster::cli {

Exchange exchange_of(const std::string& instance, const std::string& plugin) {
  Exchange result{instance, "", {}};
  std::istringstream parts(plugin);
  std::getline(parts, result.plugin, ':');
  for (std::string part; std::getline(parts, part, ':');) result.attributes.push_back(part);
  return result;
}

void exchange(World& world, const Exchange& wanted, const std::vector<std::string>& instances, const std::string& who) {
  if (std::find(instances.begin(), instances.end(), wanted.instance) == instances.end())
    throw Error(Exit::invalid_input, who + ": no instance is called " + quote(wanted.instance) +
                                         which_is(world, wanted.instance, "instance") + "; " +
                                         suggest(wanted.instance, instances) +
                                         plugin_hint(wanted.instance, whose_plugin(world.instances, wanted.instance)));
  InstanceDeclaration made = instance_of(wanted.instance, wanted.plugin, wanted.attributes, who);
  const auto old = std::find_if(world.instances.begin(), world.instances.end(),
                                [&](const auto& i) { return i.name == wanted.instance; });
  if (old == world.instances.end()) return world.instances.push_back(std::move(made));  // a provider, which came last
  const auto is_given = [&](const std::string& name) {
    return std::any_of(wanted.attributes.begin(), wanted.attributes.end(),
                       [&](const auto& word) { return word.starts_with(name + '='); });
  };
  if (!is_given("every")) made.every = old->every;
  if (old->plugin == made.plugin) {
    if (!is_given("library")) made.library = old->library;
    if (!is_given("revision")) made.revision = old->revision;
    for (const auto& attribute : old->attributes) {
      if (!is_given(attribute.name)) made.attributes.push_back(attribute);
    }
  }
  *old = std::move(made);
}

std::vector<std::string> instance_names(const Simulation& run) {
  std::vector<std::string> result;
  for (const auto& instance : run.instances()) result.push_back(instance->name());
  return result;
}

}  // namespace muster::cli
