// Sizes of a whole robot that are legal and look like millimetres, and a robot that cannot stand: whatever file it is
// of.
#pragma once

#include "description/urdf_check.hpp"

namespace muster::description {

// After all is read. Without shapes (Meshes::skip) nothing is said of where it stands.
void warn_of_body(const Source& source, bool is_mjcf, bool has_shapes, Robot& robot);

}  // namespace muster::description
