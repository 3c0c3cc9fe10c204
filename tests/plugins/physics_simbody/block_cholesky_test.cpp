// Sparse blocks against the same system as one dense matrix.
#include "block_cholesky.hpp"

#include <gtest/gtest.h>

#include <random>

namespace muster::simbody {
namespace {

// 3 a b^T, as a contact with stiffness along its normal alone.
void add(BlockCholesky& sparse, int i, int j, const Velocity& a, const Velocity& b) {
  Eigen::Matrix<double, unknowns, 3> rows_a = Eigen::Matrix<double, unknowns, 3>::Zero(), rows_b = rows_a;
  rows_a.col(0) = a;
  rows_b.col(0) = b;
  const double *of_a = rows_a.data(), *of_b = rows_b.data(), k[] = {3, 0, 0, 0};
  sparse.add_contacts(i, j, 1, &of_a, &of_b, k);
}

TEST(BlockCholesky, SolvesWhatTheDenseMatrixSolves) {
  std::mt19937 random(2);
  const auto draw = [&] { return static_cast<double>(random()) / 2147483648.0 - 1; };
  BlockCholesky sparse;
  for (int trial = 0; trial < 100; ++trial) {
    const int count = 1 + trial % 25;
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(count * unknowns, count * unknowns);
    std::vector<std::pair<int, int>> pairs;
    for (int k = 0; count > 1 && k < 2 * count; ++k) {
      const int i = static_cast<int>(random() % count), j = static_cast<int>(random() % count);
      if (i != j) pairs.push_back({i, j});
    }
    sparse.arrange(count, pairs);
    for (int pass = 0; pass < 2; ++pass) {  // the second time over the remains of the first
      dense.setZero();
      sparse.clear_pairs();
      for (int i = 0; i < count; ++i) {
        sparse.diagonal(i) = MassMatrix::Identity() * (1 + std::abs(draw()));
        dense.block<unknowns, unknowns>(i * unknowns, i * unknowns) = sparse.diagonal(i);
      }
      for (const auto& [i, j] : pairs) {
        Velocity a = Velocity::NullaryExpr([&](Eigen::Index) { return draw(); });
        Velocity b = Velocity::NullaryExpr([&](Eigen::Index) { return draw(); });
        Eigen::VectorXd row = Eigen::VectorXd::Zero(count * unknowns);
        row.segment<unknowns>(i * unknowns) = a;
        row.segment<unknowns>(j * unknowns) = b;
        dense += 3 * row * row.transpose();
        sparse.diagonal(i) += 3 * a * a.transpose();
        sparse.diagonal(j) += 3 * b * b.transpose();
        add(sparse, i, j, a, b);
      }
      Blocks<Velocity> x(count);
      Eigen::VectorXd right(count * unknowns);
      for (int i = 0; i < count; ++i) {
        x[i] = Velocity::NullaryExpr([&](Eigen::Index) { return draw(); });
        right.segment<unknowns>(i * unknowns) = x[i];
      }
      sparse.factor();
      sparse.solve(x);
      const Eigen::VectorXd expected = dense.llt().solve(right);
      for (int i = 0; i < count; ++i)
        EXPECT_LT((x[i] - expected.segment<unknowns>(i * unknowns)).norm(), 1e-9) << count << " blocks";
    }
  }
}

}  // namespace
}  // namespace muster::simbody
