// A field that readings share and that the world does not state.
#pragma once

#include "diagnosis/inference/state/model_state.hpp"
#include "diagnosis/pipeline/setup.hpp"
#include "diagnosis/result.hpp"

namespace muster::diagnosis {

// The field of the noise beside all findings, where the world states no shadowing and the readings show one beyond
// chance; nothing where readings drawn by the world itself share nearly as much: multipath is alike in neighbouring
// places, too.
std::optional<UnstatedField> unstated_field(const DiagnosisSetup& at, const inference::ModelState& state,
                                            const noise::Covariance& noise);

}  // namespace muster::diagnosis
