// Where there is room between walls.
#pragma once

#include "exam/plan.hpp"

namespace muster::exam {

// Rectangles along the plan's frame that no wall enters, the largest one first, none over another: a door is too narrow
// to be one or to join two.
std::vector<Room> rooms_between(const Plan& plan);

}  // namespace muster::exam
