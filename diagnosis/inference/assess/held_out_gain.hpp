// What the findings gain where no fit has seen: the base model, each finding in turn and each one left out, fitted
// without some places and held against these; and so for each grouping of several groups.
#pragma once

#include "diagnosis/inference/assess/finding.hpp"
#include "diagnosis/inference/state/model_state.hpp"

namespace muster::inference {

// Fills in what is measured of the result and of each finding that was accepted.
void add_held_out_gains(const ModelState& state, Result& result);

}  // namespace muster::inference
