// A diagnosis as JSON (docs/reference/diagnosis_format.md).
#pragma once

#include <nlohmann/json.hpp>

#include "diagnosis/report/words.hpp"

namespace muster::report {

nlohmann::ordered_json json_of(const Diagnosis& diagnosis);

}  // namespace muster::report
