// Effects that the noise model has swallowed: the covariance fitted with the candidate inside shows them.
#pragma once

#include "diagnosis/inference/score/candidate_scores.hpp"

namespace muster::inference {

// Leads whose gain holds under a covariance of their own. `usable` says which candidates may enter.
std::vector<ScoredCandidate> refit_noise_pass(ModelState& state, const WhitenedModel& model,
                                              const std::vector<ScoredCandidate>& first,
                                              const std::function<bool(const Candidate&)>& usable);

// Slow candidates over a ladder of shorter and weaker fields: an effect that the field has swallowed does not show at
// the fitted covariance. Gains are of the profile likelihood.
std::vector<ScoredCandidate> ladder(ModelState& state, const std::function<bool(const Candidate&)>& usable);

}  // namespace muster::inference
