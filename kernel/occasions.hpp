// What occasions and their rehearsal share: how a path reads, and where an error is told.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "blackboard.hpp"
#include "text/error.hpp"

namespace muster {

// Throws the error of `act` as one of this place in the world file, where it names none itself.
template <class Act>
void at_place(const Place& place, const Act& act) {
  try {
    act();
  } catch (const Error& e) {
    const bool is_placed =
        place.file.empty() || e.place().line > 0 || std::string(e.what()).starts_with(place.file + ':');
    throw is_placed ? e : Error(e.exit(), place, e.what());
  }
}

// "link/base/rover/rssi/rssi" as its parts.
std::vector<std::string> parts_of(const std::string& path);

// `; "yaw" is a column of robot/*/odometry` behind the refusal of a column: other tables of the same set have it.
std::string column_elsewhere(const Blackboard& board, const Table& table, const std::string& name);

// The column of this name; throws with the nearest one.
std::size_t column_of(const Blackboard& board, const Table& table, const std::string& name);

}  // namespace muster
