// Replaces a smooth by one or two named causes of its covariate that explain it.
#pragma once

#include "diagnosis/inference/state/model_state.hpp"

namespace muster::inference {

void replace_smooths(ModelState& state);

}  // namespace muster::inference
