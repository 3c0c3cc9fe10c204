// Whether an effect also shows where the predicted level lies well inside the receiver's range.
#pragma once

#include "diagnosis/inference/state/model_state.hpp"

namespace muster::inference {

// Rows are taken by their predicted level, not by the reading: a choice by outcome would bend the means.
bool stands_clear_of_clip(const Bench& bench, const noise::Covariance& covariance, const Eigen::MatrixXd& design,
                          const Eigen::MatrixXd& columns);

}  // namespace muster::inference
