// Finds rooms between walls.
#pragma once

#include "exam/plan.hpp"

namespace muster::exam {

// Disjoint rectangles along the plan's frame without walls inside, the largest one first. A door is too narrow to be
// one or to join two.
std::vector<Room> rooms_between(const Plan& plan);

}  // namespace muster::exam
