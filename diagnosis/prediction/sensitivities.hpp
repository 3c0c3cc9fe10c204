// The model's own columns: how its mean moves with each of its free parameters.
#pragma once

#include "diagnosis/prediction/free_parameters.hpp"

namespace muster::diagnosis {

struct Sensitivities {
  std::vector<std::string> paths;  // of the parameters that the readings tell apart
  Eigen::VectorXd values;          // of them, where the slopes were taken
  Eigen::VectorXd lower, upper;
  Eigen::MatrixXd slopes;  // one row a reading of the table
  Eigen::VectorXd mean;    // there
};

// At the model's present parameters.
Sensitivities sensitivities(MeasuredWorld& model, const std::vector<FitParameter>& free);

// The same columns at the readings of another model of the same world.
Eigen::MatrixXd slopes_at(MeasuredWorld& model, const Sensitivities& base);

}  // namespace muster::diagnosis
