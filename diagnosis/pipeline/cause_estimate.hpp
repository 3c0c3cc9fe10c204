// Converts a finding of the search to attributes of its plugin, with intervals.
#pragma once

#include "diagnosis/causes/cause_shape.hpp"
#include "diagnosis/radio/links/link_model.hpp"
#include "diagnosis/result.hpp"

namespace muster::diagnosis {

// Without posterior samples, as for a cause set aside, intervals of places and times have zero width.
CauseEstimate cause_estimate(const inference::Finding& finding, const CauseCandidate& cause);

// Why a cause whose strength ends at the bound that its plugin declares is no sure name: what it stands for would need
// more than there can be. Empty where none does. A bound of 0, and a share that is whole, are no such bounds.
std::string doubt_at_own_bound(const CauseEstimate& cause);

// Why a radio that is told to be elsewhere is not surely so: its place on the map lies within the intervals. Else
// empty.
std::string doubt_by_map(const CauseShape& shape, const CauseEstimate& cause, const LinkModel& model);

}  // namespace muster::diagnosis
