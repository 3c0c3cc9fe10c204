// A floor plan of one's own, from the table of walls that a world refers to.
#pragma once

#include <string>

#include "exam/plan.hpp"

namespace muster::exam {

// name,x0[m],y0[m],x1[m],y1[m],height[m],thickness[m],material, in any order. Its own frame lies along the walls, its
// corridor along x; rooms are the largest rectangles between walls, of those that robots reach from one another. Nobody
// stands in it yet, and what walls cost is not drawn. Throws std::runtime_error, with the line where there is one.
Plan plan_of_walls(const std::string& csv);

}  // namespace muster::exam
