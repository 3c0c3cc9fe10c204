// Lists candidates checked and not found, as text.
#pragma once

#include <string>
#include <vector>

#include "diagnosis/report/words.hpp"

namespace muster::report {

// True if a candidate is among the findings.
bool found(const Diagnosis& diagnosis, const std::string& id);

// Checks of candidates that were not found. Doubtful: small p without a finding, of either kind. `chance_of`: with the
// reason where it is doubtful and was tried.
struct SortedChecks {
  std::vector<const inference::Check*> along, causes, doubtful;
};
SortedChecks sorted_checks(const Diagnosis& diagnosis);
std::string chance_of(const inference::Check& check);
// "distance", "dual slope"
std::string name_of(const inference::Check& check);
constexpr const char* why_doubtful =
    "Each p is small. Where no reason is given it is not so for the number of tests made, or the causes above explain "
    "it "
    "too.";

// "outliers, people": causes tested separately, without a p-value here, and not found.
std::string tested_separately(const Diagnosis& diagnosis);

}  // namespace muster::report
