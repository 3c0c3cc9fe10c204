// Null distribution of a refined candidate's p-value, for the candidate's author.
#pragma once

#include "diagnosis/inference/score/candidate_scores.hpp"

namespace muster::inference {

// Nats by which refinement understates the p-value under the null. Slow: `draws` refinements.
double refinement_null(ModelState& state, const std::string& candidate, int draws);

}  // namespace muster::inference
