// After the forward search: what does not carry its weight, what a name explains better than a smooth, and what is the
// leftover of something stronger.
#pragma once

#include "diagnosis/inference/select/forward_selection.hpp"

namespace muster::inference {

// Terms set aside, to be shown as suspected.
std::vector<Term> clean_up(Bench& bench, std::vector<Trial>& trials);

// Gain of every term beside all others, into the terms.
void measure_gains(Bench& bench);

}  // namespace muster::inference
