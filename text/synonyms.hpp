// Words that ROS, SDF and other simulators have for what is called otherwise here.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace muster {

// The first of the valid names that means what `foreign` means elsewhere; empty if there is none.
std::string synonym(std::string_view foreign, const std::vector<std::string>& valid);

}  // namespace muster
