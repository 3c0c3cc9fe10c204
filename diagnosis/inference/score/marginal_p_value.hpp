// The p-value of columns averaged over what the covariance may be, as a t-test does for one variance.
#pragma once

#include "diagnosis/inference/state/model_state.hpp"

namespace muster::inference {

// What multiplies a chi-square tail: log of the number of tests, charges, and one half where the sign is known.
double log_tests(const Bench& bench, const Candidate& candidate);

// `fit` is the noise's fit with the columns in the design; `design` is without them. The largest of the families that
// the data do not exclude: an average would trust the family that needs the columns most.
double integrated_log_p(const Bench& bench, const noise::Fit& fit, const Eigen::MatrixXd& design,
                        const Eigen::MatrixXd& columns, double log_tests);

}  // namespace muster::inference
