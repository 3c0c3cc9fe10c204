// Causes that clip: readings that pile up at a level, or that are missing beyond it.
#pragma once

#include "diagnosis/radio/laws/law_sources.hpp"

namespace muster::diagnosis {

// Adds to the causes of `found`, and to its list of tested ones.
void add_clips(const LawSources& sources, Diagnosis& found);
// Tests for a silent floor beside the causes found: errors of the given world may hide it. `mean`, dBm: readings
// expected of the extended world. True if it is named.
bool add_silence_beside(const LawSources& sources, const Eigen::VectorXd& mean, Diagnosis& found);
// Tests for a silent floor where the table tells of no reading that is missing: what was heard may end there. True if
// it is named.
bool add_truncation(const LawSources& sources, Diagnosis& found);

}  // namespace muster::diagnosis
