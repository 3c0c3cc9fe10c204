// Reads the elements of a world file that are rows of the standard sets, as sets.hpp declares them.
#pragma once

#include "world.hpp"

namespace muster {

// Adds the rows of all standard elements below the root, references between them resolved.
void read_rows(const XmlElement& root, const Standard& standard, World& world);

// The columns of a row of that width that hold the attribute's numbers unchanged.
std::vector<std::size_t> plain_columns(const Attribute& attribute, std::size_t width);

}  // namespace muster
