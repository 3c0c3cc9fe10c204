// A place found at one noise, sought again at the noise that is fitted beside it.
#pragma once

#include "diagnosis/inference/state/model_state.hpp"

namespace muster::inference {

// Term `at`, which is a place, as each shape of its class in turn: the one with most evidence stays. With `anew` from
// all starts, else from where it is.
void settle(Bench& bench, std::size_t at, bool anew);

// All places, each beside the others.
void settle_places(Bench& bench);

}  // namespace muster::inference
