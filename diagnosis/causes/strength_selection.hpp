// Which of a cause's strengths readings tell beside the model's own parameters.
#pragma once

#include <Eigen/QR>

#include "diagnosis/causes/cause_shape.hpp"

namespace muster::diagnosis {

// What the base model's columns can take up.
class BaseSpace {
 public:
  explicit BaseSpace(const Eigen::MatrixXd& base) : turned_(base), columns_(base.cols()) {}

  // What is left of a column.
  Eigen::VectorXd rest(const Eigen::VectorXd& column) const;
  // Whether readings tell the column from the base model's parameters.
  bool leaves(const Eigen::VectorXd& column) const;

 private:
  Eigen::HouseholderQR<Eigen::MatrixXd> turned_;
  Eigen::Index columns_;
};

// Of several strengths those that readings tell apart beside the base model. What most readings have is the first to be
// the reference, at which nothing is added.
void choose_strengths(CauseShape& shape, const CauseSources& sources, const BaseSpace& base);

}  // namespace muster::diagnosis
