#include "diagnosis/inference/score/sparse_columns.hpp"

namespace muster::inference {

Thin::Thin(const Bench& bench, const Stand& stand)
    : bench_(bench),
      reach_(bench.field(), stand.whitener),
      scores_(reach_.transposed(stand.at.residual)),
      design_(stand.at.basis.q.cols(), bench.rows().size()),
      column_(Eigen::VectorXd::Zero(bench.rows().size())),
      explained_(Eigen::VectorXd::Zero(stand.at.basis.q.cols())) {
  for (Index k = 0; k < design_.rows(); ++k) design_.row(k) = reach_.transposed(stand.at.basis.q.col(k)).transpose();
}

void Thin::clear() {
  constexpr Index few = 30;  // a row reaches some fifteen, and whole vectors are cleared sooner than entries one by one
  if (static_cast<Index>(added_.size()) * few > column_.size()) {
    column_.setZero();
  } else {
    for (const Index row : added_) {
      for (const auto& [at, weight] : reach_.of(row)) column_[at] = 0;
    }
  }
  added_.clear();
  along_ = length_ = 0;
  explained_.setZero();
}

void Thin::add(Index row, double value) {
  along_ += value * scores_[row];
  explained_ += value * design_.col(row);
  added_.push_back(row);
  // In locals: the column's doubles could be members, which each would have to be stored for.
  double *const column = column_.data(), length = 0;
  for (const auto& [at, weight] : reach_.of(row)) {
    double& to = column[at];
    const double by = value * weight;
    length += by * (2 * to + by);
    to += by;
  }
  length_ += length;
}

bool Thin::take(const Eigen::VectorXd& column) {
  constexpr Index few = 5;  // a row reaches some fifteen
  concerned_.resize(column.size());
  Index count = 0;
  for (Index i = 0; i < column.size(); ++i) {
    concerned_[count] = i;
    count += column[i] != 0;  // without a branch, which nothing foretells
  }
  if (count * few > column.size()) return false;
  clear();
  for (Index k = 0; k < count; ++k) add(concerned_[k], column[concerned_[k]]);
  return true;
}

double Thin::gain() const {
  const double left = length();
  return along_ > 0 && left > 1e-6 ? along_ * along_ / left : 0;
}

}  // namespace muster::inference
