// How well the coefficients of a model are known.
#pragma once

#include "diagnosis/inference/state/model_state.hpp"

namespace muster::inference {

// Covariance of the coefficients of a design: under the covariance itself (noise/exact.hpp), and over what else the
// noise may be.
Eigen::MatrixXd uncertainty_of(const Bench& bench, const Eigen::MatrixXd& design);

}  // namespace muster::inference
