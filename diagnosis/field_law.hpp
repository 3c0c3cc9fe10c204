// Whether shadowing has the size and the decorrelation distance that the world says.
#pragma once

#include <optional>

#include "diagnosis/scatter.hpp"

namespace muster::diagnosis {

struct StatedField {
  double shadowing = 0, decorrelation = 0;  // dB; m, at which correlation falls to 1/e
};

// What a fitted covariance says of the same two.
StatedField said_by(const noise::Covariance& covariance);

// The likelihood of the fitted covariance against the best one that has a size and a distance near the stated ones:
// families of covariances differ in what they call a distance by more than data can tell, so that within `tolerance`
// all count as stated.
LawTest field_test(const search::Bench& bench, const StatedField& stated);

// Covariance of rows of which each has a residual: for a draw of the world's own shadowing.
noise::Covariance fitted_to(const search::Bench& bench, const Eigen::VectorXd& row_means);

}  // namespace muster::diagnosis
