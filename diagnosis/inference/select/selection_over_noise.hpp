// Forward selection beside more than one noise. The noise is fitted before any effect is found, and may have taken one
// up: a long field much of a step, a share that is fixed to each stream of a site the offset of one radio. Where such a
// noise was fitted the selection is made without it too, and the model that is likelier as a whole stays (penalised
// likelihood).
#pragma once

#include <memory>

#include "diagnosis/inference/select/forward_selection.hpp"

namespace muster::inference {

// Runs forward_selection on `state`, and from nothing beside the other noises that the data allow; `state` is then the
// likeliest of these models.
void selection_over_noise(std::unique_ptr<ModelState>& state, std::vector<Trial>& trials);

}  // namespace muster::inference
