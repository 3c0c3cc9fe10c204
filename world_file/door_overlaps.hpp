// Doors that overlap in one wall, as after copying one of them.
#pragma once

#include "world.hpp"

namespace muster {

// Throws Error at the second one, with both spans and a place that is free.
void refuse_overlapping_doors(const XmlElement& root, const World& world);

}  // namespace muster
