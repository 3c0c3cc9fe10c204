// What stands below the ground, z = 0, where nothing of the plan reaches down: a z that points down, as in NED.
#pragma once

#include "world.hpp"

namespace muster {

// Appends warnings.
void look_below_ground(const XmlElement& root, World& world);

}  // namespace muster
