// What was looked at beside what was found, in words.
#pragma once

#include <string>
#include <vector>

#include "diagnosis/report/words.hpp"

namespace muster::report {

// Whether a candidate is among what was found.
bool found(const Diagnosis& diagnosis, const std::string& id);

// What was checked and is not among what was found. Doubtful: small p that were not told, of either kind.
struct SortedChecks {
  std::vector<const inference::Check*> along, causes, doubtful;
};
SortedChecks sorted_checks(const Diagnosis& diagnosis);
// "distance", "dual slope"
std::string name_of(const inference::Check& check);
constexpr const char* why_doubtful =
    "Small by themselves, and not told: each is one of the many that were asked, or goes with what stands above.";

// "outliers, people": causes that were searched, each by a test of its own that has no p, and not found.
std::string asked_alone(const Diagnosis& diagnosis);

}  // namespace muster::report
