// A finding of the search as attributes of its plugin, with intervals.
#pragma once

#include "diagnosis/diagnose.hpp"

namespace muster::diagnosis {

// `term` of the bench behind the finding, or null for one that was set aside: then places and times have no interval.
FoundCause found_cause(const search::Finding& finding, const CauseCandidate& cause, const search::Bench& bench,
                       const search::Term* term);

}  // namespace muster::diagnosis
