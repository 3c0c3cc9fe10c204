// A diagnosis as text and as JSON.
#pragma once

#include <nlohmann/json.hpp>

#include "diagnosis/diagnose.hpp"

namespace muster::cli {

nlohmann::ordered_json diagnosis_json(const diagnosis::Diagnosis& found);
void print_diagnosis(const diagnosis::Diagnosis& found, const std::string& world);

}  // namespace muster::cli
