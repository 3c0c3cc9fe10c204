// The run of a bundle: a world from its start to its end, with digests on the way, and the files that it reads.
#pragma once

#include <string>
#include <vector>

#include "bundle/manifest.hpp"
#include "bundle/world_files.hpp"
#include "kernel/simulation.hpp"

namespace muster::cli {

// Before the first tick, after 1, 2, 4, 8 ... ticks and at the end: what differs from the start on shows in its table
// before it has spread. Throws Error, also where it is interrupted.
std::vector<bundle::Waymark> waymarks_of(Simulation& run, const std::string& title);

// Models of its robots, which are found by their names, and what these consist of.
void add_robots(const World& world, bundle::WorldFiles& files);
// What a plugin takes where its attribute is left out.
void add_default_files(const muster_plugin& plugin, const InstanceDeclaration& declared, bundle::WorldFiles& files);
// What the instances take, also by attributes that are given elsewhere than in the world, as an exchanged plugin's are.
void add_files_of_instances(const Simulation& run, bundle::WorldFiles& files);

}  // namespace muster::cli
