// What reading a robot says of elements in <robot>, the first of which is in line 2 of r.urdf.
#pragma once

#include <stdexcept>
#include <string>

#include "description/robot.hpp"
#include "files.hpp"

namespace muster::description {

// "r.urdf:7: ..."; "no error".
inline std::string refusal_of(const std::string& elements) {
  const Files files;
  const std::string path = files.write("r.urdf", "<robot name='r'>\n" + elements + "</robot>\n");
  try {
    read_robot(path);
  } catch (const std::runtime_error& error) {
    return files.inside(error.what());
  }
  return "no error";
}

}  // namespace muster::description
