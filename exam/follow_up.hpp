// An advised measurement, made: the truth of a case read at the places and times that a diagnosis asks for.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "exam/case.hpp"
#include "exam/planned_readings.hpp"

namespace muster::exam {

// The case of an answer file, the same to the bit. Throws std::runtime_error.
Case read_case(const std::filesystem::path& answer);

// measured.csv of the case with what is asked behind it, of the same truth and field. A station that a plan moves is
// known to stand there, and its shadowing is another one. Throws std::runtime_error for a radio that the case has not.
std::string followed_csv(Case made, const std::vector<Asked>& asked);

}  // namespace muster::exam
