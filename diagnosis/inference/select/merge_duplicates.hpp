// Merges duplicates: pieces of one class are replaced by a single theta that explains nearly all of them.
#pragma once

#include "diagnosis/inference/state/model_state.hpp"

namespace muster::inference {

// True if the terms have changed.
bool merge_pieces(ModelState& state, const std::string& pieces);

}  // namespace muster::inference
