// What the numbers of a plugin say of one another, of the run and of other plugins: orders that cannot be, and periods
// and rates that look like another unit.
#pragma once

#include <muster/plugin.h>

#include <string>
#include <vector>

#include "world_file/params.hpp"
#include "world_file/world.hpp"

namespace muster {

// Of one plugin with its values, in the order of its declarations. Throws Error where two are in the wrong order.
void check_together(const muster_plugin& plugin, const std::vector<double>& values, const InstanceDeclaration& declared,
                    const World& world, const Warn& warn);

// True where the run sets the attribute "instance/attribute" later.
bool is_set_later(const World& world, const std::string& path);

}  // namespace muster
