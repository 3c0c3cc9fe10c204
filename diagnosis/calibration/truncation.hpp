// Tests if a table ends at a floor: where a receiver hears nothing below a level and a log keeps only what was heard,
// rows are missing of which nothing tells (truncation, as against censoring: Cohen 1991, Truncated and Censored
// Samples).
#pragma once

#include <Eigen/Core>

namespace muster::diagnosis {

struct Truncation {
  double floor = 0;     // dBm; the weakest reading
  double evidence = 0;  // nats; log-likelihood of levels normal above the floor only, less that of levels anywhere
  double near = 0;      // readings closely above the floor
  double expected = 0;  // as many, with that floor

  // True if readings go on up to the floor: where there are few, the means are too low instead.
  bool is_abrupt() const;
};

// `mean`, `sigma`: of the level of each of `heard` [dBm], none of which is NaN, given those before it; `half_code`:
// half a step between readings, dB. Without a floor `evidence` has the exponential distribution of mean 1 where
// readings are independent, and about that elsewhere: the probability that none lies below the weakest is the product
// over all readings of their chances to lie above it, given those before.
Truncation truncation_of(const Eigen::VectorXd& heard, const Eigen::VectorXd& mean, const Eigen::VectorXd& sigma,
                         double half_code);

}  // namespace muster::diagnosis
