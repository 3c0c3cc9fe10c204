// A radio that seems to be out of its place stands where another one is said to be: whoever exchanged their names. What
// else is wrong with the other radio hides that from a search that finds one cause after another.
#pragma once

#include <optional>

#include "diagnosis/pipeline/setup.hpp"
#include "diagnosis/result.hpp"

namespace muster::diagnosis {

// The exchange of this finding's row with another that explains the readings of that row as well as all that was found
// does, with the finding's evidence; nothing if there is none.
std::optional<CauseEstimate> exchange_instead_of(const CauseEstimate& finding, DiagnosisSetup& setup,
                                                 const Diagnosis& found);

}  // namespace muster::diagnosis
