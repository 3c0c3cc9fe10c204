// What is legal in missions and orders and cannot go as it is written: messages that nobody says or awaits, steps that
// are never come to, places that are too far. Each doubt is a warning with its place.
#pragma once

#include <muster/plugin.hpp>
#include <string>
#include <vector>

#include "text/xml.hpp"

namespace muster::missions {

// Of the mission of a robot; `root` is its file.
std::vector<std::string> doubts_of_mission(const Setup& setup, const std::string& robot, const XmlElement& root);
// Of orders: those that no mission waits for.
std::vector<std::string> doubts_of_orders(const Setup& setup, const XmlElement& root);

}  // namespace muster::missions
