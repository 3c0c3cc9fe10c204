// What the numbers of a plugin say of one another, of the run and of other plugins: orders that cannot be, and periods
// and rates that look like another unit.
#pragma once

#include <muster/plugin.h>

#include <map>
#include <string>
#include <vector>

#include "link.hpp"
#include "world_file/params.hpp"

namespace muster {

// Of one plugin with its values, in the order of its declarations. Throws Error where two are in the wrong order.
void check_together(const muster_plugin& plugin, const std::vector<double>& values, const InstanceDeclaration& declared,
                    const World& world, const Warn& warn);

// Warnings of thresholds of readers beyond which a table has no values: its writer's clip, of the same name, is nearer.
std::vector<std::string> beyond_clips(const std::map<std::string, Claimed>& claimed, const World& world);

}  // namespace muster
