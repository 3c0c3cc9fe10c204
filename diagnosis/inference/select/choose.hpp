// Chooses which of the significant candidates enters.
#pragma once

#include "diagnosis/inference/score/candidate_scores.hpp"

namespace muster::inference {

// Candidates compared at their best (smooths grown, causes refined), the chosen one first. `passing` are significant,
// `all` are all candidates of this round.
std::vector<ScoredCandidate> compared(const ModelState& state, const WhitenedModel& model,
                                      const std::vector<ScoredCandidate>& passing,
                                      const std::vector<ScoredCandidate>& all,
                                      const std::function<bool(const Candidate&)>& usable);

}  // namespace muster::inference
