// A smooth that one or two named causes of its covariate explain gives way to them.
#pragma once

#include "diagnosis/inference/state/model_state.hpp"

namespace muster::inference {

void replace_smooths(Bench& bench);

}  // namespace muster::inference
