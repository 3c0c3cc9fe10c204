// An exam made, sat and graded through the program.
#pragma once

#include "grade.hpp"

namespace muster::exam {

// `wanted`: arguments of `muster exam make` but its folder.
Grades examined(const std::string& wanted);

}  // namespace muster::exam
