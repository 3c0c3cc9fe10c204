// Effects that only a fitted field could swallow: they show beside the field that the model states.
#pragma once

#include <optional>

#include "diagnosis/inference/score/candidate_scores.hpp"

namespace muster::inference {

// The best slow cause or smooth that is beyond chance beside the stated field, if that field, with the cause in the
// model, is as likely as any other. So a sender's offset is not taken for a larger and wider field than is stated; a
// wrong statement explains nothing, since no single cause makes up for it. `usable` says which candidates may enter.
std::optional<Lead> stated_look(Bench& bench, const std::function<bool(const Candidate&)>& usable);

}  // namespace muster::inference
