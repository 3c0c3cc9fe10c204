// What the world says of the scatter of readings, and what they do: a field that it does not state, or another scatter.
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
// The scatter of the readings about the fitted world, where it lies far outside that of the world's own draws;
// nothing where the world draws none. The laws of single readings may not be testable, and shadowing may pass for the
// noise of readings that never repeat a place: all of it together is always seen.
std::optional<OtherScatter> other_scatter(const DiagnosisSetup& at, const inference::ModelState& state);

}  // namespace muster::diagnosis
