// Columns beside the rest of a model: what they explain of what it leaves, and how well their coefficients are known.
#pragma once

#include "diagnosis/inference/state/model_state.hpp"

namespace muster::inference {

struct Explained {
  Eigen::VectorXd coefficients;
  Eigen::MatrixXd covariance;
  double gain = 0;  // fall of the deviance
};

struct Beside : Explained {
  Eigen::MatrixXd columns;  // whitened, without what the rest explains

  // `whole`: the columns count as they are (Candidate::whole).
  Beside(const Stand& rest, const Eigen::MatrixXd& plain, bool whole);
};

}  // namespace muster::inference
