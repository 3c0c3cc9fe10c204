// What a look along one covariate needs: its values on the fit's rows and the shapes to try.
#pragma once

#include "diagnosis/calibration/fit.hpp"
#include "diagnosis/calibration/residual_structure.hpp"

namespace muster::diagnosis {

struct Subject {
  std::string by, unit;
  std::vector<double> values;  // one a used row; NaN: none. Empty for names
  std::vector<int> level;      // names: one a used row, -1: none
  std::vector<std::string> names;
  Eigen::MatrixXd shapes;  // one a row of the fit
  bool by_shape = false;   // bins are the shapes' own coefficients (walls), not ranges
};

// Structure in the residual along these shapes, tested with errors refitted beside them, so that they do not swallow
// it. Where `shared` is false, readings share nothing by the world's own word, and whatever they do share is structure.
Look look_along(const Fit& fit, const Subject& subject, bool shared);
// Its p-value alone.
double chance_of_structure(const Fit& fit, const Eigen::MatrixXd& shapes, bool shared);
// That readings which share nothing seem to, by twice the log-likelihood that shared variances gain.
double chance_of_sharing(double evidence);

// Shapes for a number over its range, for an angle, and for names.
Eigen::MatrixXd waves(const std::vector<double>& values, int count);
Eigen::MatrixXd lobes(const std::vector<double>& angles, int count);
Eigen::MatrixXd indicators(const std::vector<int>& level, std::size_t levels);

}  // namespace muster::diagnosis
