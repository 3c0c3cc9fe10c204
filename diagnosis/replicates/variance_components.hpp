// Variances of independent normal values as a sum of components of known shape: MINQUE, the minimum norm quadratic
// unbiased estimation of C. R. Rao (Journal of Multivariate Analysis 1, 1971).
#pragma once

#include <Eigen/Core>

namespace muster::diagnosis {

struct VarianceComponents {
  Eigen::VectorXd value;  // of each component, times its shape the variance; not below 0
  Eigen::VectorXd stderror;
  Eigen::VectorXd freedom;  // of a chi-square with the same mean and variance (Satterthwaite); 0 where value is 0
};

// `squares`: n squared values. `shapes`: n x components, the variance of each value where a component is 1. Their noise
// does not bias the result as long as `weights`, shapes as well, from which the estimator takes its weights, do not
// share it. `kurtosis`: fourth moment of the values by the squared second, 3 of a normal law; above it the freedom
// falls.
VarianceComponents variance_components(const Eigen::VectorXd& squares, const Eigen::MatrixXd& shapes,
                                       const Eigen::MatrixXd& weights, double kurtosis = 3);

}  // namespace muster::diagnosis
