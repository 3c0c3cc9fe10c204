// Effects that the noise model has swallowed: the covariance fitted with the candidate inside shows them.
#pragma once

#include "diagnosis/inference/score/candidate_scores.hpp"

namespace muster::inference {

// Leads whose gain holds under a covariance of their own. `usable` says which candidates may enter.
std::vector<Lead> second_look(Bench& bench, const Stand& stand, const std::vector<Lead>& first,
                              const std::function<bool(const Candidate&)>& usable);

// Slow candidates over a ladder of shorter and weaker fields: an effect that the field has swallowed does not show at
// the fitted covariance. Gains are of the profile likelihood.
std::vector<Lead> ladder(Bench& bench, const std::function<bool(const Candidate&)>& usable);

}  // namespace muster::inference
