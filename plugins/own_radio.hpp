// A robot's own radio.
#pragma once

#include <muster/plugin.hpp>
#include <string>

namespace muster {

// The row of the radio with the name of the robot that the parameter `robot` refers to.
inline double own_radio(const Setup& setup) {
  const muster_host* host = setup.host();
  const char* robot = host->row_name(host, "robot", static_cast<uint32_t>(setup.param("robot")));
  for (uint32_t row = 0; robot && row < host->rows(host, "radio"); ++row) {
    if (std::string(host->row_name(host, "radio", row)) == robot) return row;
  }
  throw BadInput("the robot has no radio of its own name");
}

}  // namespace muster
