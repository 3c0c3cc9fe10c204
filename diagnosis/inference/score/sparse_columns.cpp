#include "diagnosis/inference/score/sparse_columns.hpp"

namespace muster::inference {

SparseColumns::SparseColumns(const ModelState& state, const WhitenedModel& model)
    : state_(state),
      reach_(state.field(), model.whitener),
      scores_(reach_.transposed(model.at.residual)),
      design_(model.at.basis.q.cols(), state.rows().size()),
      column_(Eigen::VectorXd::Zero(state.rows().size())),
      explained_(Eigen::VectorXd::Zero(model.at.basis.q.cols())) {
  for (Index k = 0; k < design_.rows(); ++k) design_.row(k) = reach_.transposed(model.at.basis.q.col(k)).transpose();
}

void SparseColumns::clear() {
  constexpr Index few = 30;  // a row reaches some fifteen; a whole vector clears faster than entries one by one
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

void SparseColumns::add(Index row, double value) {
  along_ += value * scores_[row];
  added_.push_back(row);
  // Locals, so that the compiler need not store members at every entry: the column's doubles could alias them.
  double *const column = column_.data(), *const explained = explained_.data(), length = 0;
  const double* const design = design_.data() + row * design_.rows();
  for (Index k = 0, end = design_.rows(); k < end; ++k) explained[k] += value * design[k];
  for (const auto& [at, weight] : reach_.of(row)) {
    double& to = column[at];
    const double by = value * weight;
    length += by * (2 * to + by);
    to += by;
  }
  length_ += length;
}

bool SparseColumns::take(const Eigen::Ref<const Eigen::VectorXd>& column) {
  constexpr Index few = 5;    // a row reaches some fifteen
  constexpr Index block = 8;  // most of which are zero
  concerned_.resize(column.size());
  Index count = 0;
  const auto look = [&](Index first, Index end) {
    for (Index i = first; i < end; ++i) {
      concerned_[count] = i;
      count += column[i] != 0;  // branch-free: a branch would be unpredictable
    }
  };
  const Index last = column.size() - column.size() % block;
  for (Index i = 0; i < last; i += block) {
    if (column.segment<block>(i).cwiseAbs().maxCoeff() > 0) look(i, i + block);
  }
  look(last, column.size());
  if (count * few > column.size()) return false;
  clear();
  for (Index k = 0; k < count; ++k) add(concerned_[k], column[concerned_[k]]);
  return true;
}

double SparseColumns::gain() const {
  const double left = length();
  return along_ > 0 && left > 1e-6 ? along_ * along_ / left : 0;
}

}  // namespace muster::inference
