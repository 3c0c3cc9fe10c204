// Meshes from files of others. Assimp's importers crash, hang and write out of bounds on hostile input, so the bytes
// are parsed in a child process with little memory and time, and what it hands back is checked again.
#pragma once

#include <string>

#include "description/robot.hpp"

namespace muster::description {

// An .stl, .obj or .dae file inside `folder`; throws std::runtime_error with what is wrong (without file and line).
Mesh read_mesh(const std::string& folder, const std::string& file, const Eigen::Vector3d& scale);

}  // namespace muster::description
