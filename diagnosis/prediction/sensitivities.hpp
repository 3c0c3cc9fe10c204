// Sensitivities: the model's design matrix, derivatives of its mean by each free parameter.
#pragma once

#include "diagnosis/prediction/free_parameters.hpp"

namespace muster::diagnosis {

struct Sensitivities {
  std::vector<std::string> paths;  // of the identifiable parameters
  Eigen::VectorXd values;          // of those, at the derivatives
  Eigen::VectorXd lower, upper;
  Eigen::MatrixXd slopes;  // one row a reading of the table
  Eigen::VectorXd mean;    // at the same values

  // The mean extrapolated linearly to zero parameters. Measured minus offset, regressed on the slopes, gives values of
  // parameters as coefficients.
  Eigen::VectorXd offset() const { return mean - slopes * values; }
};

// At the model's current parameters.
Sensitivities sensitivities(MeasuredWorld& model, const std::vector<FitParameter>& free);

// The same columns at the readings of another model of the same world.
Eigen::MatrixXd slopes_at(MeasuredWorld& model, const Sensitivities& base);

}  // namespace muster::diagnosis
