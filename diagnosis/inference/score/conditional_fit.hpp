// Columns beside the rest of a model: what they explain of what it leaves, and how well their coefficients are known.
#pragma once

#include "diagnosis/inference/state/model_state.hpp"

namespace muster::inference {

struct ConditionalGain {
  Eigen::VectorXd coefficients;
  Eigen::MatrixXd covariance;
  double gain = 0;  // fall of the deviance
};

struct ConditionalFit : ConditionalGain {
  Eigen::MatrixXd columns;  // whitened, without what the rest explains

  // `whole`: the columns count as they are (Candidate::whole).
  ConditionalFit(const WhitenedModel& rest, const Eigen::MatrixXd& plain, bool whole);
};

}  // namespace muster::inference
