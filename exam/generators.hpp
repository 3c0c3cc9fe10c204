// Makes cases by one of the generators: drawn (the exam's own plans and fields), run (the simulator's readings), field
// (as people measure), or anybody's command.
#pragma once

#include <filesystem>

#include "exam/arguments.hpp"

namespace muster::exam {

const Arguments& options_of_generators();

// Makes --cases cases from --first on in a folder, and prints a line of each. `keep`: those with an answer are left
// alone. Throws std::invalid_argument for options, std::runtime_error for all else.
void make_cases(const Arguments& arguments, const std::filesystem::path& out, bool keep);

// Ids of what the generator of --generator hides, marked where they are outside the vocabulary.
std::vector<std::string> effects_of_generator(const Arguments& arguments);

}  // namespace muster::exam
