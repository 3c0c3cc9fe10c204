// The elements of a world file that are rows of the standard sets, read as sets.hpp declares them.
#pragma once

#include "world.hpp"

namespace muster {

// Adds the rows of all standard elements below the root, references between them resolved.
void read_rows(const XmlElement& root, const Standard& standard, World& world);

// Names stand in paths: letters, digits, and _ - . but no more.
bool is_name(const std::string& text);
void check_name(const XmlAttribute& given);

}  // namespace muster
