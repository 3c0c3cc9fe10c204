// Covariance of a model's coefficients.
#pragma once

#include "diagnosis/inference/state/model_state.hpp"

namespace muster::inference {

// Covariance of the coefficients of a design (GLS): under the exact covariance
// (inference/noise/exact_covariance.hpp), and over the posterior of the noise.
Eigen::MatrixXd coefficient_covariance(const ModelState& state, const Eigen::MatrixXd& design);

}  // namespace muster::inference
