#include "exchange.hpp"

#include <algorithm>
#include <sstream>

#include "run_options.hpp"
#include "text/names.hpp"
#include "world_file/kinds.hpp"

namespace muster::cli {

namespace {

// Of "step=0.002,integrator=rk3" where its comma is; npos of no such text.
std::size_t comma_before_attribute(const std::string& part) {
  for (std::size_t comma = part.find(','); comma != part.npos; comma = part.find(',', comma + 1)) {
    const std::size_t end = part.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_", comma + 1);
    if (end != part.npos && end > comma + 1 && part[end] == '=') return comma;
  }
  return part.npos;
}

}  // namespace

Exchange exchange_of(const std::string& instance, const std::string& plugin) {
  Exchange result{instance, "", {}};
  std::istringstream parts(plugin);
  std::getline(parts, result.plugin, ':');
  for (std::string part; std::getline(parts, part, ':');) {
    if (const std::size_t comma = comma_before_attribute(part); comma != part.npos) {
      std::string meant = plugin;
      meant[plugin.find(part) + comma] = ':';
      throw Error(Exit::invalid_input,
                  quote(part) + ": a comma stands between attributes; expected ':' there: " + instance + '=' + meant);
    }
    result.attributes.push_back(part);
  }
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
