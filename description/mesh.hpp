// Meshes from untrusted files. Assimp's importers crash, hang and write out of bounds on hostile input. So a child
// process with little memory and time parses the bytes, and its result is checked again.
#pragma once

#include <string>

#include "description/robot.hpp"

namespace muster::description {

// An .stl, .obj or .dae file inside `folder`; throws std::runtime_error with the fault (without file and line).
Mesh read_mesh(const std::string& folder, const std::string& file, const Eigen::Vector3d& scale);

}  // namespace muster::description
