// Tests the residual for structure along one covariate: its values on the fit's rows and the shapes to try.
#pragma once

#include "diagnosis/calibration/fit.hpp"
#include "diagnosis/calibration/residual_structure.hpp"

namespace muster::diagnosis {

struct Subject {
  std::string by, unit;
  std::vector<double> values;  // one a used row; NaN: missing. Empty for names
  std::vector<int> level;      // names: one a used row, -1: missing
  std::vector<std::string> names;
  Eigen::MatrixXd shapes;  // one a row of the fit
  bool by_shape = false;   // bins are the shapes' own coefficients (walls), not ranges
};

// Tests for structure along these shapes. The errors are refitted beside them, so that they do not absorb it. With
// `shared` false the world declares independent errors, and any shared part counts as structure.
StructureTest structure_along(const Fit& fit, const Subject& subject, bool shared);
// The same test's p-value alone.
double chance_of_structure(const Fit& fit, const Eigen::MatrixXd& shapes, bool shared);
// P-value of apparent sharing between independent readings, from twice the log-likelihood gained by shared variances.
double chance_of_sharing(double evidence);

// Shapes for a number over its range, for an angle, and for names, in turn.
Eigen::MatrixXd waves(const std::vector<double>& values, int count);
Eigen::MatrixXd lobes(const std::vector<double>& angles, int count);
Eigen::MatrixXd indicators(const std::vector<int>& level, std::size_t levels);

}  // namespace muster::diagnosis
