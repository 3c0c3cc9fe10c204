// Thresholds that a clip of another plugin leaves without effect.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "link.hpp"

namespace muster {

// Warnings of thresholds of readers beyond which a table has no values: its writer's clip, of the same name, is nearer.
std::vector<std::string> beyond_clips(const std::map<std::string, Claimed>& claimed, const World& world);

}  // namespace muster
