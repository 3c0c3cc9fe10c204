// What the numbers of a plugin say of one another, of the run and of other plugins: orders that cannot be, and periods
// and rates that look like another unit.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "instance.hpp"
#include "world_file/params.hpp"

namespace muster {

// Of one plugin with its values, in the order of its declarations. Throws Error where two are in the wrong order.
void check_together(const muster_plugin& plugin, const std::vector<double>& values, const InstanceDeclaration& declared,
                    const World& world, const Warn& warn);

// Plugins that are parts of one radio channel and state different carriers; `tell` takes whole warnings.
void compare_carriers(const std::vector<std::unique_ptr<Instance>>& instances,
                      const std::function<void(const std::string&)>& tell);

}  // namespace muster
