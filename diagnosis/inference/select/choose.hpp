// Which of the candidates that pass is to be named.
#pragma once

#include "diagnosis/inference/score/candidate_scores.hpp"

namespace muster::inference {

// The candidates to compare, at their best: smooths grown, causes refined; the one to take first. `passing` are
// significant, `all` are all leads of this round.
std::vector<ScoredCandidate> compared(const ModelState& state, const WhitenedModel& model,
                                      const std::vector<ScoredCandidate>& passing,
                                      const std::vector<ScoredCandidate>& all,
                                      const std::function<bool(const Candidate&)>& usable);

}  // namespace muster::inference
