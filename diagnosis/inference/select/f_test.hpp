// Least squares of a few means, and the F test of what columns explain of them beside a design.
#pragma once

#include <Eigen/Core>

namespace muster::inference {

struct LeastSquares {
  Eigen::Index rank = 0;
  double squares = 0;  // left
};

LeastSquares least_squares(const Eigen::MatrixXd& design, const Eigen::VectorXd& y);

// Log p; 0 where the columns add nothing to the design, or fit each row.
double log_p_of_f_test(const Eigen::MatrixXd& design, const Eigen::MatrixXd& columns, const Eigen::VectorXd& y);

}  // namespace muster::inference
