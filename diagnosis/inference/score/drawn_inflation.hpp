// Inflation of gains in the model's own draws. A covariance has the first two moments of what a model draws: a field of
// a few waves, or none but rounding, has more structure than that. Where the model draws its errors itself, gains are
// calibrated on its draws.
#pragma once

#include "diagnosis/inference/state/model_state.hpp"

namespace muster::inference {

// Factor by which the candidate's highest gain over its grid in draws of the model exceeds that in white noise: median
// over median; at least 1, and 1 where the model draws nothing. `model`: a whitened one, at the field of the draws.
double drawn_inflation(const ModelState& state, const WhitenedModel& model, const Candidate& candidate);

}  // namespace muster::inference
