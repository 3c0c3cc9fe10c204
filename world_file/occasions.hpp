// Reads <at> and <swap>: what happens while a run goes on.
#pragma once

#include "world.hpp"

namespace muster {

// <at t=> or <at when=>: numbers set, robots that join or leave, plugins swapped, inserted or removed. Rows of the
// robots in it are in the world already. Throws Error.
void read_at(const XmlElement& element, const Standard& standard, World& world);

// <swap at= instance= plugin= ...> beside the plugins. Throws Error.
void read_swap_element(const XmlElement& element, World& world);

// Throws where a plugin is changed that is never there, or inserted under a name that is taken.
void check_occasions(const World& world);

// Warns of what is set twice at one time. Where a condition decides, nothing is known.
void warn_of_vain_changes(World& world);

}  // namespace muster
