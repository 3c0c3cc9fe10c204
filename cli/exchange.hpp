// An instance of a world exchanged for another plugin, by one word: "physics=physics.simbody:integrator=rk3".
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "verbs.hpp"

namespace muster::cli {

struct Exchange {
  std::string instance, plugin;
  std::vector<std::string> attributes;  // "NAME=VALUE"
};

// "physics.simbody:integrator=rk3", the new plugin of an instance.
Exchange exchange_of(const std::string& instance, const std::string& plugin);

// The instance keeps its name, its place among the others, and how often it steps; of its own plugin also the
// attributes that are not given. `instances`: the names of all that the world has, providers too; `who` gave the words,
// for messages. Throws Error.
void exchange(World& world, const Exchange& wanted, const std::vector<std::string>& instances, const std::string& who);

std::vector<std::string> instance_names(const Simulation& run);

}  // namespace muster::cli
