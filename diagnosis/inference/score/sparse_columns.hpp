// Columns that are zero at most rows, whitened only where they are not.
#pragma once

#include "diagnosis/inference/noise/whitener_columns.hpp"
#include "diagnosis/inference/state/model_state.hpp"

namespace muster::inference {

class SparseColumns : public Tally {
 public:
  // Keeps references to both.
  SparseColumns(const ModelState& state, const WhitenedModel& model);

  Index rows() const override { return state_.rows().size(); }
  void clear() override;
  void add(Index row, double value) override;
  double gain() const override;

  // Takes a whole column. False if it has so many non-zero rows that whitening it at once is faster.
  bool take(const Eigen::Ref<const Eigen::VectorXd>& column);

  double along() const { return along_; }                               // product with the residual
  double length() const { return length_ - explained_.squaredNorm(); }  // squared, the design projected out

 private:
  const ModelState& state_;
  noise::Reach reach_;
  Eigen::VectorXd scores_;  // products of each row's unit column with the residual
  Eigen::MatrixXd design_;  // and with the orthonormal design, whose columns are its rows

  Eigen::Matrix<Index, Eigen::Dynamic, 1> concerned_;  // non-zero rows of the column in take(), from the front
  Eigen::VectorXd column_;                             // whitened
  std::vector<Index> added_;                           // rows
  double along_ = 0, length_ = 0;
  Eigen::VectorXd explained_;
};

}  // namespace muster::inference
