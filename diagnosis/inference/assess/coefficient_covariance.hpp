// Covariance of a model's coefficients, and of what they explain.
#pragma once

#include "diagnosis/inference/state/model_state.hpp"

namespace muster::inference {

// Covariance of the coefficients of a design (GLS): under the exact covariance
// (inference/noise/exact_covariance.hpp), and over the posterior of the noise.
Eigen::MatrixXd coefficient_covariance(const ModelState& state, const Eigen::MatrixXd& design);

// Mean share of a reading's variance that fitting these columns takes up, in the data's unit squared: cov(y, X b) of
// GLS, the mean over readings of x' C x with C the covariance of the coefficients. `model` is the whitened model of
// `design`.
double taken_up_by_fit(const ModelState& state, const Eigen::MatrixXd& design, const WhitenedModel& model);

}  // namespace muster::inference
