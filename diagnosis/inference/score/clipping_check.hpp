// Tests if an effect is also present where the predicted level lies well inside the measurable range.
#pragma once

#include "diagnosis/inference/state/model_state.hpp"

namespace muster::inference {

// Rows are selected by their predicted level: selection by the reading itself would bias the means.
bool separable_from_clipping(const ModelState& state, const noise::Covariance& covariance,
                             const Eigen::MatrixXd& design, const Eigen::MatrixXd& columns);

}  // namespace muster::inference
