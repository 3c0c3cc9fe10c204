// Re-scores candidates with the covariance refitted beside each: the first fit may have absorbed them.
#pragma once

#include "diagnosis/inference/select/remembered_leads.hpp"

namespace muster::inference {

// Leads with scores under a covariance of their own. `usable`: filter of candidates that may enter; beside a model that
// is known it only excludes more.
std::vector<ScoredCandidate> refit_noise_pass(ModelState& state, const WhitenedModel& model,
                                              const std::vector<ScoredCandidate>& first,
                                              const std::function<bool(const Candidate&)>& usable,
                                              RememberedRound& known);

// Slow candidates over a ladder of shorter and weaker fields: the fitted field may hide an effect that it has
// absorbed. Gains are of the profile likelihood.
std::vector<ScoredCandidate> ladder(ModelState& state, const std::function<bool(const Candidate&)>& usable);

}  // namespace muster::inference
