// Exact variance of sums of rows. Vecchia conditions on few neighbours and understates long-range variance.
#pragma once

#include "diagnosis/inference/noise/reml.hpp"

namespace muster::noise {

// Variance of the field at each row, squared units of a reading: not the same everywhere where the model states it.
Eigen::VectorXd field_variances(const Field& field, const Covariance& covariance);

// Covariance of weights^T rows: squared units of a reading times the weights' units. One row a row, one column a sum.
// Visits every pair of rows.
Eigen::MatrixXd covariance_of_sums(const Field& field, const Covariance& covariance, const Eigen::MatrixXd& weights);

// Exact covariance of added^T residual, which Vecchia's approximation takes for the identity. `added`: whitened
// columns, orthonormal and orthogonal to the design. The residual is that of whitened rows.
Eigen::MatrixXd scatter_of(const Field& field, const Whitener& whitener, const Eigen::MatrixXd& added);

// Fall of the deviance by such columns, scaled to be chi-square under the null with the exact covariance.
double exact_gain(const Field& field, const Whitener& whitener, const Eigen::MatrixXd& added,
                  const Eigen::VectorXd& residual);

}  // namespace muster::noise
