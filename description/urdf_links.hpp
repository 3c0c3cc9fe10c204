// Links and joints of a URDF, as urdfdom reads them.
#pragma once

#include <string>

#include "description/robot.hpp"
#include "description/urdf_check.hpp"

namespace muster::description {

// `text`: of the whole file; `root`: its document. `outline` is set to the lines and the order of what it declares.
// Throws with file and line where the file is not what URDF allows.
Robot from_urdf(const Source& source, const tinyxml2::XMLElement& root, const std::string& text, Meshes meshes,
                const UrdfSetting& setting, Outline& outline);

}  // namespace muster::description
