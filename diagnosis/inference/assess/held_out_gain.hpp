// What the findings gain where no fit has seen: the base model, each finding in turn and each one left out, fitted
// without some places and held against these; and so for radios and runs where there are several.
#pragma once

#include "diagnosis/inference/assess/finding.hpp"
#include "diagnosis/inference/state/model_state.hpp"

namespace muster::inference {

// Fills in what is measured of the result and of each finding that was accepted.
void hold_out(const Bench& bench, Result& result);

}  // namespace muster::inference
