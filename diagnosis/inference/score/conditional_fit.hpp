// Fits columns to the residual of the rest of a model: gain, coefficients and their covariance.
#pragma once

#include "diagnosis/inference/state/model_state.hpp"

namespace muster::inference {

struct ConditionalGain {
  Eigen::VectorXd coefficients;
  Eigen::MatrixXd covariance;
  double gain = 0;  // fall of the deviance
};

struct ConditionalFit : ConditionalGain {
  Eigen::MatrixXd columns;  // whitened, the rest projected out

  // `whole`: coefficients are held at 1 (CandidateDesign::whole).
  ConditionalFit(const WhitenedModel& rest, const Eigen::MatrixXd& plain, bool whole);
};

}  // namespace muster::inference
