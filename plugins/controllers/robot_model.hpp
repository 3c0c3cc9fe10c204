// What a controller says of a robot whose model cannot do what it asks for.
#pragma once

#include <muster/plugin.hpp>
#include <string>
#include <vector>

#include "description/world_robots.hpp"

namespace muster {

// `the model "scarab" of robot "rover" (world.xml:6:3)`, of the robot that the parameter `robot` refers to.
inline std::string model_in_words(const Setup& s) {
  const std::string name = s.host()->row_name(s.host(), "robot", static_cast<uint32_t>(s.param("robot")));
  return "the model \"" + s.text("robot/" + name + "/model") + "\" of robot \"" + name + "\" (" +
         s.text("robot/" + name + "/place") + ")";
}

// `, or a model that WHAT: a, b`, of the models whose files have `element`; "" where there are none.
inline std::string or_a_model(const Setup& s, const char* element, const std::string& what) {
  std::vector<std::string> folders;
  for (uint32_t i = 0; const char* next = s.host()->search_path(s.host(), i); ++i)
    folders.push_back(std::string(next) + "/models");
  std::string have;
  for (const std::string& each : description::models_with(element, folders)) have += (have.empty() ? "" : ", ") + each;
  return have.empty() ? "" : ", or a model that " + what + ": " + have;
}

}  // namespace muster
