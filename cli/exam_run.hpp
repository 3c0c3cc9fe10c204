// The cases of an exam, run by a command.
#pragma once

#include <string>

#include "command_line.hpp"

namespace muster::cli {

// muster exam run, and the words behind it. The exit code; throws Error.
int run_exam_cases(const Arguments& arguments);

// muster_exam beside this program.
std::string exam_program();

}  // namespace muster::cli
