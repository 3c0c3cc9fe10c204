// Selects the identifiable strengths of a cause: columns linearly independent of the base model and of one another.
#pragma once

#include <Eigen/QR>

#include "diagnosis/causes/cause_shape.hpp"

namespace muster::diagnosis {

// Column space of the base model, by a Householder QR decomposition.
class BaseSpace {
 public:
  explicit BaseSpace(const Eigen::MatrixXd& base) : turned_(base), columns_(base.cols()) {}

  // Component orthogonal to the base model's columns.
  Eigen::VectorXd rest(const Eigen::VectorXd& column) const;
  // True if the column is identifiable beside the base model.
  bool leaves(const Eigen::VectorXd& column) const;

 private:
  Eigen::HouseholderQR<Eigen::MatrixXd> turned_;
  Eigen::Index columns_;
};

// Keeps those of several strengths that are identifiable together, by Gram-Schmidt. The strength of most readings is
// dropped first: it becomes the reference, at which nothing is added.
void choose_strengths(CauseShape& shape, const CauseSources& sources, const BaseSpace& base);

}  // namespace muster::diagnosis
