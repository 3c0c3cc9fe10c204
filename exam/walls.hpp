// Builds a user's own floor plan from the table of walls of a world.
#pragma once

#include <string>

#include "exam/plan.hpp"

namespace muster::exam {

// Reads name,x0[m],y0[m],x1[m],y1[m],height[m],thickness[m],material, in any order. The plan's frame lies along the
// walls, with the corridor along x. Rooms are the largest rectangles between walls that robots can reach from one
// another. The plan has no stations, and no wall losses. Throws std::runtime_error, with the line if there is one.
Plan plan_of_walls(const std::string& csv);

}  // namespace muster::exam
