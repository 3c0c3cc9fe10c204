// Re-scores candidates with the field that the model states: only a fitted field could have absorbed them.
#pragma once

#include <optional>

#include "diagnosis/inference/select/forward_selection.hpp"

namespace muster::inference {

// The best slow cause or smooth that is significant beside the stated field. With it in the model that field must fit
// as well as any other. So a constant offset of one group is not absorbed by a larger and wider field than stated. A
// wrong statement does no harm, since no single cause makes up for it. `usable`: filter of candidates that may enter.
// One that may be how stays differ by chance is added to the trials.
std::optional<ScoredCandidate> stated_noise_pass(ModelState& state, const std::function<bool(const Candidate&)>& usable,
                                                 std::vector<Trial>& trials);

}  // namespace muster::inference
