// What continuous refinement costs: nulls refined as the data are, for the author of a candidate.
#pragma once

#include "diagnosis/inference/score/candidate_scores.hpp"

namespace muster::inference {

// Nats by which the p-value of the refined candidate is too small when nothing is there. Slow: `draws` refinements.
double refinement_charge(Bench& bench, const std::string& candidate, int draws);

}  // namespace muster::inference
