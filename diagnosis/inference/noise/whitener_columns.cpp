#include "diagnosis/inference/noise/whitener_columns.hpp"

namespace muster::noise {
namespace {

// Calls each(row, reached, weight) for every non-zero entry of the whitener.
template <class Each>
void each_entry(const Field& field, const Stencil& stencil, const Each& each) {
  for (Index i = 0; i < field.size(); ++i) {
    each(i, i, stencil.own[at(i)]);
    for (int a = 0; a < field.slots(); ++a) {
      const Index j = field.neighbour(i, a);
      if (j >= 0) each(j, i, stencil.beside[at(i * field.slots() + a)]);
    }
  }
}

}  // namespace

Reach::Reach(const Field& field, const Whitener& whitener) : first_(at(field.size()) + 1) {
  const Stencil& stencil = whitener.stencil();
  each_entry(field, stencil, [&](Index row, Index, double) { ++first_[at(row) + 1]; });
  for (std::size_t k = 1; k < first_.size(); ++k) first_[k] += first_[k - 1];
  entries_.resize(first_.back());
  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  each_entry(field, stencil, [&](Index row, Index reached, double weight) {
    entries_[next[at(row)]++] = {reached, weight};
  });
}

Eigen::VectorXd Reach::transposed(const Eigen::VectorXd& whitened) const {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(whitened.size());
  for (Index row = 0; row < result.size(); ++row) {
    for (const Entry& e : of(row)) result[row] += e.weight * whitened[e.row];
  }
  return result;
}

}  // namespace muster::noise
