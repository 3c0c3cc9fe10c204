// Chooses which of the significant candidates enters.
#pragma once

#include "diagnosis/inference/select/remembered_leads.hpp"

namespace muster::inference {

// Candidates compared at their best (smooths grown, causes refined), the chosen one first. `passing` are significant,
// `all` are all candidates of this round, `known` those that were refined beside this model.
std::vector<ScoredCandidate> compared(const ModelState& state, const WhitenedModel& model,
                                      const std::vector<ScoredCandidate>& passing,
                                      const std::vector<ScoredCandidate>& all,
                                      const std::function<bool(const Candidate&)>& usable, RememberedLeads& known);

}  // namespace muster::inference
