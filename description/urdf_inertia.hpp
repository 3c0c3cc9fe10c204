// Inertias of a URDF's links, held against what a body can have and against the link's own collision shapes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "description/robot.hpp"

namespace muster::description {

// True if one of the shapes, meshes aside, is larger than any robot: it is in millimetres.
bool is_oversized(const std::vector<Shape>& shapes);

// Collision shapes filled with a density of 1 kg/m3, in their link's frame; none where there are no shapes, or a mesh
// among them.
std::optional<Mass> filled(const std::vector<Shape>& shapes);

// An <inertial> with these figures, as a link would have it.
std::string inertial_text(const Mass& mass);

// `expected a mass above 0: ...`, of a link with these shapes that has none.
std::string expected_mass(const std::vector<Shape>& shapes);

// Checks the mass and inertia of a link as its URDF gives them: `mass` in its inertial frame, which `frame` puts into
// the link. Throws std::runtime_error, without a place, for an inertia that no body has; one that breaks the triangle
// inequality by up to a tenth is widened until it holds. Warns of that, of an inertia beyond ten times or below a tenth
// of that of the shapes filled evenly, and of a mass above osmium's or below 1 kg/m3 of their volume.
void check_inertia(Mass& mass, const Eigen::Isometry3d& frame, const std::vector<Shape>& shapes,
                   std::vector<std::string>& warnings);

}  // namespace muster::description
