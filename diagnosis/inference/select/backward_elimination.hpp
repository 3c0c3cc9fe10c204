// Backward elimination after the forward selection: drops weak terms, replaces smooths by causes, and sets aside
// residual artifacts of stronger terms.
#pragma once

#include "diagnosis/inference/select/forward_selection.hpp"

namespace muster::inference {

// Returns the terms set aside, to be reported as suspected.
std::vector<Term> backward_elimination(ModelState& state, std::vector<Trial>& trials);

// Updates the gain and evidence of every term beside all others.
void measure_gains(ModelState& state);

}  // namespace muster::inference
