// Which of the candidates that pass is to be named.
#pragma once

#include "diagnosis/inference/score/candidate_scores.hpp"

namespace muster::inference {

// The candidates to compare, at their best: smooths grown, causes refined; the one to take first. `passing` are
// significant, `all` are all leads of this round.
std::vector<Lead> compared(const Bench& bench, const Stand& stand, const std::vector<Lead>& passing,
                           const std::vector<Lead>& all, const std::function<bool(const Candidate&)>& usable);

}  // namespace muster::inference
