// Columns that are zero at most rows, whitened at those alone that they reach.
#pragma once

#include "diagnosis/inference/noise/whitener_columns.hpp"
#include "diagnosis/inference/state/model_state.hpp"

namespace muster::inference {

class Thin : public Tally {
 public:
  // Keeps references to both.
  Thin(const Bench& bench, const Stand& stand);

  Index rows() const override { return bench_.rows().size(); }
  void clear() override;
  void add(Index row, double value) override;
  double gain() const override;

  // A whole column instead, unless it is not zero at so many rows that it is whitened sooner in one go.
  bool take(const Eigen::VectorXd& column);

  double along() const { return along_; }                               // product with the residual
  double length() const { return length_ - explained_.squaredNorm(); }  // squared, of what the design leaves

 private:
  const Bench& bench_;
  noise::Reach reach_;
  Eigen::VectorXd scores_;  // products of each row's unit column with the residual
  Eigen::MatrixXd design_;  // and with the design, whose columns are its rows

  Eigen::Matrix<Index, Eigen::Dynamic, 1> concerned_;  // the first so many: rows of a column that it takes
  Eigen::VectorXd column_;                             // whitened
  std::vector<Index> added_;                           // rows
  double along_ = 0, length_ = 0;
  Eigen::VectorXd explained_;
};

}  // namespace muster::inference
