#include "block_cholesky.hpp"

#include <algorithm>

namespace muster::simbody {

template <int N>
void BlockCholeskyOf<N>::arrange(int count, const std::vector<std::pair<int, int>>& pairs) {
  diagonal_.resize(count);
  inverse_.resize(count);
  columns_.resize(count);
  order_.resize(count);
  place_.assign(count, -1);
  if (count == 1) {
    columns_[0].clear();
    order_[0] = place_[0] = 0;
    return;
  }
  std::vector<std::vector<int>> beside(count);
  for (const auto& [i, j] : pairs) beside[i].push_back(j), beside[j].push_back(i);
  for (auto& list : beside) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  std::vector<int> joined;
  for (int step = 0; step < count; ++step) {
    int k = -1;
    for (int i = 0; i < count; ++i) {
      if (place_[i] < 0 && (k < 0 || beside[i].size() < beside[k].size())) k = i;
    }
    order_[step] = k;
    place_[k] = step;
    columns_[k].resize(beside[k].size());
    for (std::size_t n = 0; n < beside[k].size(); ++n) {
      const int i = beside[k][n];
      columns_[k][n].row = i;
      joined.clear();  // the remaining neighbours of both become neighbours of i
      std::set_union(beside[i].begin(), beside[i].end(), beside[k].begin(), beside[k].end(),
                     std::back_inserter(joined));
      joined.erase(std::remove_if(joined.begin(), joined.end(), [&](int j) { return j == i || j == k; }), joined.end());
      beside[i] = joined;
    }
  }
}

template <int N>
void BlockCholeskyOf<N>::clear_pairs() {
  static const MassMatrix zero = MassMatrix::Zero();
  for (auto& column : columns_) {
    for (Below& below : column) of_robots_.copy(below.block.data(), zero.data());
  }
}

template <int N>
MassMatrixOf<N>& BlockCholeskyOf<N>::below(int row, int column) {
  const auto at = std::lower_bound(columns_[column].begin(), columns_[column].end(), row,
                                   [](const Below& b, int wanted) { return b.row < wanted; });
  return at->block;
}

template <int N>
void BlockCholeskyOf<N>::add_contacts(int i, int j, int count, const double* const* a, const double* const* b,
                                      const double* k) {
  if (place_[i] > place_[j]) {
    of_robots_.add_contacts(below(i, j).data(), count, a, b, k);
  } else {
    of_robots_.add_contacts(below(j, i).data(), count, b, a, k);
  }
}

template <int N>
void BlockCholeskyOf<N>::factor() {
  if constexpr (has_many_joints) {
    is_alone_ = order_.size() == 1 && couples_joints_by_body();
    if (is_alone_) return factor_alone();
  }
  for (const int k : order_) {
    of_robots_.invert_factor(diagonal_[k].data(), inverse_[k].data());
    auto& column = columns_[k];
    for (Below& below_k : column) of_robots_.multiply(below_k.block.data(), inverse_[k].data());
    for (std::size_t m = 0; m < column.size(); ++m) {
      const Below& a = column[m];
      of_robots_.subtract(diagonal_[a.row].data(), a.block.data(), a.block.data());
      for (std::size_t n = 0; n < m; ++n) {
        const Below& b = column[n];
        if (place_[a.row] > place_[b.row]) {
          of_robots_.subtract(below(a.row, b.row).data(), a.block.data(), b.block.data());
        } else {
          of_robots_.subtract(below(b.row, a.row).data(), b.block.data(), a.block.data());
        }
      }
    }
  }
}

template <int N>
bool BlockCholeskyOf<N>::couples_joints_by_body() const {
  for (int j = 6; j < N; ++j) {
    for (int i = j + 1; i < N; ++i) {
      if (diagonal_[0](i, j) != 0) return false;
    }
  }
  return true;
}

template <int N>
void BlockCholeskyOf<N>::factor_alone() {
  const MassMatrix& m = diagonal_[0];
  const Eigen::Matrix<double, 6, N - 6> coupling = m.template topRightCorner<6, N - 6>();
  body_by_joints_ = coupling * m.diagonal().template tail<N - 6>().cwiseInverse().asDiagonal();
  BodyBlock rest = m.template topLeftCorner<6, 6>();
  of_bodies_.subtract(rest.data(), body_by_joints_.data(), coupling.data());
  of_bodies_.invert_factor(rest.data(), body_.data());
}

template <int N>
void BlockCholeskyOf<N>::solve(Blocks<Velocity>& x) const {
  if constexpr (has_many_joints) {
    if (is_alone_) return solve_alone(x[0]);
  }
  for (const int k : order_) {
    of_robots_.apply_transposed(x[k].data(), inverse_[k].data());
    for (const Below& b : columns_[k]) of_robots_.subtract_product(x[b.row].data(), b.block.data(), x[k].data());
  }
  for (auto k = order_.rbegin(); k != order_.rend(); ++k) {
    for (const Below& b : columns_[*k]) of_robots_.subtract_transposed(x[*k].data(), b.block.data(), x[b.row].data());
    of_robots_.apply(x[*k].data(), inverse_[*k].data());
  }
}

template <int N>
void BlockCholeskyOf<N>::solve_alone(Velocity& x) const {
  double *body = x.data(), *joints = body + 6;
  of_bodies_.subtract_product(body, body_by_joints_.data(), joints);
  of_bodies_.apply_transposed(body, body_.data());
  of_bodies_.apply(body, body_.data());
  for (int j = 0; j < N - 6; ++j) joints[j] /= diagonal_[0](6 + j, 6 + j);
  of_bodies_.subtract_transposed(joints, body_by_joints_.data(), body);
}

template class BlockCholeskyOf<unknowns>;
template class BlockCholeskyOf<unknowns_with_legs>;

}  // namespace muster::simbody
