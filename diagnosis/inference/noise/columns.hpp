// Columns put side by side.
#pragma once

#include <Eigen/Core>

namespace muster::noise {

// [design, columns]; both have the same number of rows.
inline Eigen::MatrixXd hstack(const Eigen::MatrixXd& design, const Eigen::MatrixXd& columns) {
  Eigen::MatrixXd both(design.rows(), design.cols() + columns.cols());
  both << design, columns;
  return both;
}

}  // namespace muster::noise
