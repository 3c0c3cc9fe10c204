// What a world's elements say of one another and looks like another unit or a slip: walls that stand twice, doors
// higher than their walls, antennas below the ground.
#pragma once

#include "world.hpp"

namespace muster {

// Appends warnings. Call it once the world is read whole. Throws Error for a floor that no scene can hold.
void look_for_doubts(const XmlElement& root, World& world);

}  // namespace muster
