// One object stays one object: pieces of one class give way to a single theta that explains nearly all of them.
#pragma once

#include "diagnosis/inference/state/model_state.hpp"

namespace muster::inference {

// True if the terms have changed.
bool merge_pieces(Bench& bench, const std::string& pieces);

}  // namespace muster::inference
