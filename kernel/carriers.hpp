// Radio plugins of one channel that are of different bands.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "instance.hpp"

namespace muster {

// Plugins that are parts of one radio channel and state different carriers; `tell` takes whole warnings.
void compare_carriers(const std::vector<std::unique_ptr<Instance>>& instances,
                      const std::function<void(const std::string&)>& tell);

}  // namespace muster
