// A finding of the search as attributes of its plugin, with intervals.
#pragma once

#include "diagnosis/causes/cause_shape.hpp"
#include "diagnosis/result.hpp"

namespace muster::diagnosis {

// Where nothing is known of how sure it is, as of what was set aside, places and times have no width.
FoundCause found_cause(const inference::Finding& finding, const CauseCandidate& cause);

}  // namespace muster::diagnosis
