#include "diagnosis/search/thin.hpp"

namespace muster::search {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

// each(row, reached, weight) for all that is not zero in the whitener.
template <class Each>
void each_entry(const noise::Field& field, const noise::Stencil& stencil, const Each& each) {
  for (Index i = 0; i < field.size(); ++i) {
    each(i, i, stencil.own[at(i)]);
    for (int a = 0; a < field.slots(); ++a) {
      const Index j = field.neighbour(i, a);
      if (j >= 0) each(j, i, stencil.beside[at(i * field.slots() + a)]);
    }
  }
}

}  // namespace

Thin::Thin(const Bench& bench, const Stand& stand)
    : bench_(bench),
      first_(at(bench.rows().size()) + 1),
      scores_(Eigen::VectorXd::Zero(bench.rows().size())),
      design_(Eigen::MatrixXd::Zero(stand.at.basis.q.cols(), bench.rows().size())),
      column_(Eigen::VectorXd::Zero(bench.rows().size())),
      explained_(Eigen::VectorXd::Zero(stand.at.basis.q.cols())) {
  const noise::Field& field = bench.field();
  const noise::Stencil& stencil = stand.whitener.stencil();
  each_entry(field, stencil, [&](Index row, Index, double) { ++first_[at(row) + 1]; });
  for (std::size_t k = 1; k < first_.size(); ++k) first_[k] += first_[k - 1];
  reached_.resize(first_.back());
  weight_.resize(first_.back());
  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  each_entry(field, stencil, [&](Index row, Index reached, double weight) {
    reached_[next[at(row)]] = reached;
    weight_[next[at(row)]++] = weight;
    scores_[row] += weight * stand.at.residual[reached];
    design_.col(row) += weight * stand.at.basis.q.row(reached).transpose();
  });
}

void Thin::clear() {
  for (const Index i : touched_) column_[i] = 0;
  touched_.clear();
  along_ = length_ = 0;
  explained_.setZero();
}

void Thin::add(Index row, double value) {
  along_ += value * scores_[row];
  explained_ += value * design_.col(row);
  for (std::size_t j = first_[at(row)]; j < first_[at(row) + 1]; ++j) {
    double& to = column_[reached_[j]];
    const double by = value * weight_[j];
    if (to == 0) touched_.push_back(reached_[j]);
    length_ += by * (2 * to + by);
    to += by;
  }
}

double Thin::gain() const {
  const double left = length();
  return along_ > 0 && left > 1e-6 ? along_ * along_ / left : 0;
}

}  // namespace muster::search
