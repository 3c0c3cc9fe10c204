// What changes in time beside what stands at a place, where the readings tell neither from the other.
#pragma once

#include <string>
#include <vector>

#include "diagnosis/causes/cause_shape.hpp"
#include "diagnosis/inference/select/alternatives.hpp"

namespace muster::diagnosis {

// The doubt of a cause in time beside a place that fits the readings as well, as where a robot passes once. The place
// has less evidence only for the many where it could be, which is no reason to say that time is the cause. Empty where
// there is none. `all`: causes of the search.
std::string doubt_by_place(const CauseCandidate& cause, const std::vector<inference::Alternative>& alternatives,
                           const std::vector<CauseCandidate>& all);

}  // namespace muster::diagnosis
