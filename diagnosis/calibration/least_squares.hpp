// Two ways to the same minimum, so that each checks the other: Levenberg and Marquardt's on derivatives, and Powell's
// BOBYQA (2009), which needs none.
#pragma once

#include "diagnosis/calibration/censored_likelihood.hpp"

namespace muster::diagnosis {

struct Minimum {
  Eigen::VectorXd parameters;
  double sigma = 0;     // dB, maximum likelihood
  double deviance = 0;  // at that sigma
  int evaluations = 0;  // of the mean
  bool converged = false;
  std::vector<bool> at_bound{};
};

// Inside the box, from `start`.
Minimum least_squares(const Readings& readings, const Mean& mean, const Eigen::VectorXd& start, const Box& box);
Minimum gradient_free(const Readings& readings, const Mean& mean, const Eigen::VectorXd& start, const Box& box);

}  // namespace muster::diagnosis
