// Re-scores near misses with the censored readings drawn nearer to each (ModelState::draw_towards): those of the model
// without a cause hide what it gains.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "diagnosis/inference/score/candidate_scores.hpp"

namespace muster::inference {

// The lead that is significant then: the best cause, or else the best smooth. The draws are put back.
std::optional<ScoredCandidate> nearer_draws_pass(ModelState& state, std::vector<ScoredCandidate> looked,
                                                 const std::function<bool(const Candidate&)>& usable);

}  // namespace muster::inference
