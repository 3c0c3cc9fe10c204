// An exam made, sat and graded through the program.
#pragma once

#include "exam/grading/grade.hpp"

namespace muster::exam {

// `wanted`: arguments of `muster exam make` but its folder. `command`: as `muster exam run` takes it, `muster` being
// the program; empty: one diagnosis.
Grades examined(const std::string& wanted, const std::string& command = "");

}  // namespace muster::exam
