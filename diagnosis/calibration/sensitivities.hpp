// The model's own columns: how its mean moves with each of its free parameters.
#pragma once

#include "diagnosis/calibration/fit.hpp"

namespace muster::diagnosis {

struct BaseColumns {
  std::vector<std::string> paths;  // of the parameters that the readings tell apart
  Eigen::VectorXd values;          // of them, where the slopes were taken
  Eigen::VectorXd lower, upper;
  Eigen::MatrixXd slopes;  // one row a reading of the table
  Eigen::VectorXd mean;    // there
};

// At the model's present parameters.
BaseColumns base_columns(LinkModel& model, const std::vector<FitParameter>& free);

// The same columns at the readings of another model of the same world.
Eigen::MatrixXd slopes_at(LinkModel& model, const BaseColumns& base);

}  // namespace muster::diagnosis
