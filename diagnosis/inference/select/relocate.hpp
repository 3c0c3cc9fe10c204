// Relocates a place after the noise was refitted with it in the model.
#pragma once

#include "diagnosis/inference/state/model_state.hpp"

namespace muster::inference {

// Relocates term `at`, a place, over the shapes of its class; the one with most evidence is kept. With `anew` from
// all starts, else from its current theta.
void relocate(ModelState& state, std::size_t at, bool anew);

// Relocates all places, each beside the others.
void relocate_places(ModelState& state);

}  // namespace muster::inference
