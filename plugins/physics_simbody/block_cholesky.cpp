#include "block_cholesky.hpp"

#include <algorithm>

namespace muster::simbody {

namespace {

// Of the lower triangle. Products with it are unrolled, which solving by a triangle of this size is not.
template <class Matrix>
void invert(const Matrix& lower, Matrix& inverse) {
  inverse.setZero();
  for (int column = 0; column < lower.cols(); ++column) {
    inverse(column, column) = 1 / lower(column, column);
    for (int row = column + 1; row < lower.rows(); ++row) {
      double sum = 0;
      for (int k = column; k < row; ++k) sum += lower(row, k) * inverse(k, column);
      inverse(row, column) = -sum / lower(row, row);
    }
  }
}

}  // namespace

template <int N>
void BlockCholeskyOf<N>::arrange(int count, const std::vector<std::pair<int, int>>& pairs) {
  diagonal_.resize(count);
  factor_.resize(count);
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
      joined.clear();  // who is left of both becomes a neighbour of i
      std::set_union(beside[i].begin(), beside[i].end(), beside[k].begin(), beside[k].end(),
                     std::back_inserter(joined));
      joined.erase(std::remove_if(joined.begin(), joined.end(), [&](int j) { return j == i || j == k; }), joined.end());
      beside[i] = joined;
    }
  }
}

template <int N>
void BlockCholeskyOf<N>::clear_pairs() {
  for (auto& column : columns_) {
    for (Below& below : column) below.block.setZero();
  }
}

template <int N>
MassMatrixOf<N>& BlockCholeskyOf<N>::below(int row, int column) {
  const auto at = std::lower_bound(columns_[column].begin(), columns_[column].end(), row,
                                   [](const Below& b, int wanted) { return b.row < wanted; });
  return at->block;
}

template <int N>
void BlockCholeskyOf<N>::add(int i, int j, double k, const Velocity& a, const Velocity& b) {
  if (place_[i] > place_[j]) {
    below(i, j).noalias() += (k * a) * b.transpose();
  } else {
    below(j, i).noalias() += (k * b) * a.transpose();
  }
}

template <int N>
void BlockCholeskyOf<N>::factor() {
  if (is_alone()) {
    const MassMatrix& m = diagonal_[0];
    joints_by_body_ =
        m.diagonal().template tail<N - 6>().cwiseInverse().asDiagonal() * m.template bottomLeftCorner<N - 6, 6>();
    BodyBlock rest = m.template topLeftCorner<6, 6>();
    rest.noalias() -= m.template topRightCorner<6, N - 6>().lazyProduct(joints_by_body_);
    body_.compute(rest);
    return;
  }
  if (order_.size() == 1) {
    factor_[0].compute(diagonal_[0]);
    return;
  }
  for (const int k : order_) {
    factor_[k].compute(diagonal_[k]);
    invert(factor_[k].matrixLLT(), inverse_[k]);
    auto& column = columns_[k];
    for (Below& below_k : column) below_k.block = below_k.block.lazyProduct(inverse_[k].transpose()).eval();
    for (std::size_t m = 0; m < column.size(); ++m) {
      const Below& a = column[m];
      diagonal_[a.row].noalias() -= a.block.lazyProduct(a.block.transpose());
      for (std::size_t n = 0; n < m; ++n) {
        const Below& b = column[n];
        if (place_[a.row] > place_[b.row]) {
          below(a.row, b.row).noalias() -= a.block.lazyProduct(b.block.transpose());
        } else {
          below(b.row, a.row).noalias() -= b.block.lazyProduct(a.block.transpose());
        }
      }
    }
  }
}

template <int N>
void BlockCholeskyOf<N>::solve(std::vector<Velocity>& x) const {
  if (is_alone()) {
    Eigen::Matrix<double, 6, 1> body = x[0].template head<6>();
    auto joints = x[0].template tail<N - 6>();
    body.noalias() -= joints_by_body_.transpose() * joints;
    body_.solveInPlace(body);
    x[0].template head<6>() = body;
    joints = joints.cwiseQuotient(diagonal_[0].diagonal().template tail<N - 6>()).eval();
    joints.noalias() -= joints_by_body_ * body;
    return;
  }
  if (order_.size() == 1) {
    factor_[0].solveInPlace(x[0]);
    return;
  }
  for (const int k : order_) {
    x[k] = inverse_[k].lazyProduct(x[k]).eval();
    for (const Below& b : columns_[k]) x[b.row].noalias() -= b.block.lazyProduct(x[k]);
  }
  for (auto k = order_.rbegin(); k != order_.rend(); ++k) {
    for (const Below& b : columns_[*k]) x[*k].noalias() -= b.block.transpose().lazyProduct(x[b.row]);
    x[*k] = inverse_[*k].transpose().lazyProduct(x[*k]).eval();
  }
}

template class BlockCholeskyOf<unknowns>;
template class BlockCholeskyOf<unknowns_with_legs>;

}  // namespace muster::simbody
