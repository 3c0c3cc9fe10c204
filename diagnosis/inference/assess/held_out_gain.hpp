// Held-out gains by cross-validation: of the base model, of each finding in turn, and without each finding. Over
// blocks of places, and over each grouping of several groups.
#pragma once

#include "diagnosis/inference/assess/finding.hpp"
#include "diagnosis/inference/state/model_state.hpp"

namespace muster::inference {

// Fills in the held-out figures of the result and of each accepted finding.
void add_held_out_gains(const ModelState& state, Result& result);

}  // namespace muster::inference
