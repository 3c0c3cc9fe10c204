// Two minimisers that check each other: Levenberg-Marquardt with derivatives, and Powell's BOBYQA (2009) without any.
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

// Minimise within the box, from `start`.
Minimum least_squares(const Readings& readings, const Mean& mean, const Eigen::VectorXd& start, const Box& box);
Minimum derivative_free_fit(const Readings& readings, const Mean& mean, const Eigen::VectorXd& start, const Box& box);

}  // namespace muster::diagnosis
