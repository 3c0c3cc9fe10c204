// Describes a robot's body for the page: its shapes, and the joints that a recorded column turns (wheels, legs).
#pragma once

#include "description/robot.hpp"
#include "text/json.hpp"

namespace muster::viewer {

// {"radius": of its footprint [m],
//  "joints": [{"quantity": "wheels", "column": "left", "at": [3], "turn": [4], "axis": [3]}],
//  "parts": [{"shape", ..., "at": [3], "turn": [4], "joint": index or absent, "main": of the largest link}]}
// A link shows its <visual> shapes, or its shapes for collisions where it has none. Joints that no table records are at
// zero.
Json parts_of(const description::Robot& robot);

// "vertices" and "faces" as flat lists, added to the description of a mesh; to a hundredth of a millimetre.
void add_triangles(const description::Mesh& mesh, Json& description);

}  // namespace muster::viewer
