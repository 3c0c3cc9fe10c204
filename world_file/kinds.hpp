// Names that are looked up as one kind of thing and are another's: a station where a robot is expected.
#pragma once

#include <string>

#include "world.hpp"

namespace muster {

// `station` of a row or `instance` that has the name and adds no row to the set `wanted`; "" where there is none.
std::string kind_of_name(const World& world, const std::string& name, const std::string& wanted = "");

// `, which is a station (world.xml:5:3)` behind `no robot is called "base"`; "" where nothing else has the name.
std::string which_is(const World& world, const std::string& name, const std::string& wanted = "");

}  // namespace muster
