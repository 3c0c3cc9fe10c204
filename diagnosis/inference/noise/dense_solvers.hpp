// Decompositions of small dense matrices. Eigen's templates for one of them take seconds to compile: here they do so
// once.
#pragma once

#include <Eigen/Core>
#include <memory>

namespace muster::noise {

// Solves a x = b for a symmetric positive semi-definite a (L D L^T, pivoted).
Eigen::VectorXd solve_symmetric(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);
Eigen::MatrixXd solve_symmetric(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

// Coefficients of least squares: columns have full rank.
Eigen::VectorXd regress(const Eigen::MatrixXd& columns, const Eigen::VectorXd& y);
Eigen::MatrixXd regress(const Eigen::MatrixXd& columns, const Eigen::MatrixXd& y);
// What turns any y into those coefficients: columns x rows. The second also takes columns that depend on each other,
// and gives the coefficients of least norm.
Eigen::MatrixXd regression_gain(const Eigen::MatrixXd& columns);
Eigen::MatrixXd least_norm_gain(const Eigen::MatrixXd& columns);

// a = vectors * diag(values) * vectors^T, values ascending; only a's lower triangle is read.
struct SymmetricEigen {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};
SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& a);

// a = L L^T; `positive` is false, and nothing else may be asked, where a is not positive definite.
class Cholesky {
 public:
  explicit Cholesky(const Eigen::MatrixXd& a);
  ~Cholesky();
  Cholesky(const Cholesky&) = delete;
  Cholesky& operator=(const Cholesky&) = delete;

  bool positive() const;
  double log_determinant() const;
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  Eigen::MatrixXd solve(const Eigen::MatrixXd& b) const;
  Eigen::MatrixXd lower() const;

 private:
  struct Root;
  std::unique_ptr<const Root> root_;
};

// a = L D L^T for a symmetric positive semi-definite a that is solved with more than once.
class SymmetricSolver {
 public:
  explicit SymmetricSolver(const Eigen::MatrixXd& a);
  ~SymmetricSolver();
  SymmetricSolver(const SymmetricSolver&) = delete;
  SymmetricSolver& operator=(const SymmetricSolver&) = delete;

  double log_determinant() const;  // pivots of 0 count as 1e-300
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  Eigen::MatrixXd solve(const Eigen::MatrixXd& b) const;

 private:
  struct Root;
  std::unique_ptr<const Root> root_;
};

}  // namespace muster::noise
