// What sums over all rows scatter by under a covariance itself. Vecchia's approximation, which gives such sums, tells
// each row by few others and so believes to know better than it does what is alike over long ways.
#pragma once

#include "diagnosis/inference/noise/reml.hpp"

namespace muster::noise {

// Covariance of weights^T rows, dB^2 times the weights' units; a row a row, a sum a column. Takes every pair of rows.
Eigen::MatrixXd covariance_of_sums(const Sites& sites, const Covariance& covariance, const Eigen::MatrixXd& weights);

// Covariance of added^T residual: whitened columns, orthonormal and apart from the design, and what the design leaves
// of whitened rows. The approximation takes it for the identity.
Eigen::MatrixXd scatter_of(const Field& field, const Whitener& whitener, const Eigen::MatrixXd& added);

// The fall of the deviance by such columns that is distributed as chi-square under the covariance itself where nothing
// is there.
double exact_gain(const Field& field, const Whitener& whitener, const Eigen::MatrixXd& added,
                  const Eigen::VectorXd& residual);

}  // namespace muster::noise
