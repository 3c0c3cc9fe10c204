// P-value of columns, averaged over the posterior of the covariance, as a t-test does for one variance.
#pragma once

#include "diagnosis/inference/state/model_state.hpp"

namespace muster::inference {

// Log factor of a chi-square tail: number of tests, charges, and one half where the sign is fixed.
double log_tests(const ModelState& state, const Candidate& candidate);

// In the family of `fit`, the noise with the columns in the design. `design`: without them.
double marginal_log_p(const ModelState& state, const noise::Fit& fit, const Eigen::MatrixXd& design,
                      const Eigen::MatrixXd& columns, double log_tests);
// The maximum over the other families that the data do not exclude, -infinity if there is none: an average would favour
// the family most dependent on the columns. Above `decided` no further one is tried.
double marginal_log_p_elsewhere(const ModelState& state, const noise::Fit& fit, const Eigen::MatrixXd& design,
                                const Eigen::MatrixXd& columns, double log_tests, double decided);

}  // namespace muster::inference
