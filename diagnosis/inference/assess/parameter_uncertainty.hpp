// Joint uncertainty of a term's theta (place, time or shape) and its coefficients.
#pragma once

#include "diagnosis/inference/state/model_state.hpp"

namespace muster::inference {

struct ParameterUncertainty {
  // Equally likely draws from the posterior, the coefficients integrated out. One for a term without parameters.
  std::vector<Eigen::VectorXd> thetas;
  // Covariance of the coefficients over those and over the posterior of the noise, under the exact covariance
  // (inference/noise/exact_covariance.hpp). At least the sandwich estimate from residuals over cells (Huber 1967),
  // which shows a poorly fitting shape.
  Eigen::MatrixXd coefficients;
};

ParameterUncertainty parameter_uncertainty(const ModelState& state, const Term& term);

// Among equally likely thetas that explain nearly as much as the term's, the one whose effect is nearest to their
// mean effect. It minimises the expected error on new readings.
Eigen::VectorXd middle_of(const ModelState& state, const Term& term, const ParameterUncertainty& spread);

}  // namespace muster::inference
