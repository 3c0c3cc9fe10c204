// Forward selection where fields may be long. A long field can take up an effect, and a short one can leave structure
// that effects then explain: where both are possible the selection is made under either prior, and the model that is
// likelier as a whole stays (penalised likelihood).
#pragma once

#include <memory>

#include "diagnosis/inference/select/forward_selection.hpp"

namespace muster::inference {

// Runs forward_selection on `state`. Where its prior is wider than the usual one, also under that, from nothing;
// `state` is then the likelier of the two.
void selection_over_ranges(std::unique_ptr<ModelState>& state, std::vector<Trial>& trials);

}  // namespace muster::inference
