// Converts a diagnosis to JSON (docs/reference/diagnosis_format.md).
#pragma once

#include "diagnosis/report/words.hpp"
#include "text/json.hpp"

namespace muster::report {

Json json_of(const Diagnosis& diagnosis);

}  // namespace muster::report
