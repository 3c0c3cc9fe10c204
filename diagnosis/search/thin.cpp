#include "diagnosis/search/thin.hpp"

namespace muster::search {

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
  for (std::size_t k = 0; k < reached_; ++k) column_[touched_[k]] = 0;
  reached_ = 0;
  along_ = length_ = 0;
  explained_.setZero();
}

void Thin::add(Index row, double value) {
  along_ += value * scores_[row];
  explained_ += value * design_.col(row);
  const noise::Reach::Entries entries = reach_.of(row);
  const auto most = reached_ + static_cast<std::size_t>(entries.last - entries.first);
  if (touched_.size() < most) touched_.resize(2 * most);
  for (const auto& [reached, weight] : entries) {
    double& to = column_[reached];
    const double by = value * weight;
    touched_[reached_] = reached;
    reached_ += to == 0;  // without a branch, which nothing foretells
    length_ += by * (2 * to + by);
    to += by;
  }
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

}  // namespace muster::search
