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

// Throws BadInput where the reference `attribute` names the radio `own`: nobody sends to itself, nor hears itself.
// `whose`: "the robot's own radio". `neither`: another that it cannot be; `otherwise`: what to do where there is no
// third.
inline void expect_another_radio(const Setup& setup, const char* attribute, double own, const char* whose,
                                 double neither = -1, const char* otherwise = "") {
  if (setup.param(attribute) != own || own < 0) return;
  const muster_host* host = setup.host();
  std::string others;
  for (uint32_t row = 0; row < host->rows(host, "radio"); ++row) {
    if (row != own && row != neither)
      others += (others.empty() ? "" : ", ") + std::string(host->row_name(host, "radio", row));
  }
  throw BadInput("attribute \"" + std::string(attribute) + "\": \"" +
                 host->row_name(host, "radio", static_cast<uint32_t>(own)) + "\" is " + whose + "; expected another" +
                 (others.empty() ? std::string(", and the world has none") + otherwise : ": " + others));
}

}  // namespace muster
