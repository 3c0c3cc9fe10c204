// Carries out an advised measurement: reads a case's truth at the planned places and times.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "exam/case.hpp"
#include "exam/planned_readings.hpp"

namespace muster::exam {

// Remakes the case of an answer file, bit for bit. Throws std::runtime_error.
Case read_case(const std::filesystem::path& answer);

// measured.csv of the case with the planned readings appended, from the same truth and field. A station moved by the
// plan has a known place and new shadowing. Throws std::runtime_error for a radio that is not in the case.
std::string followed_csv(Case made, const std::vector<PlannedReadings>& asked);

}  // namespace muster::exam
