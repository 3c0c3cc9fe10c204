// Families of the noise that are fitted beside the present one.
#pragma once

#include "diagnosis/inference/state/model_state.hpp"

namespace muster::inference {

// The first fits of families other than this one, the best first. Of those that differ in their fixed share alone there
// is one, and none where `present` has such a share: a fit goes over the shares, and its value has one minimum there.
std::vector<noise::Fit> other_families(const std::vector<noise::Fit>& families, noise::Family present);

}  // namespace muster::inference
