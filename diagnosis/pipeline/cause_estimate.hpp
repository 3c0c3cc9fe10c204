// Converts a finding of the search to attributes of its plugin, with intervals.
#pragma once

#include "diagnosis/causes/cause_shape.hpp"
#include "diagnosis/result.hpp"

namespace muster::diagnosis {

// Without posterior samples, as for a cause set aside, intervals of places and times have zero width.
CauseEstimate cause_estimate(const inference::Finding& finding, const CauseCandidate& cause);

}  // namespace muster::diagnosis
