#include "diagnosis/inference/noise/dense_solvers.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>

namespace muster::noise {

using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd solve_symmetric(const MatrixXd& a, const VectorXd& b) { return a.ldlt().solve(b); }
MatrixXd solve_symmetric(const MatrixXd& a, const MatrixXd& b) { return a.ldlt().solve(b); }

VectorXd regress(const MatrixXd& columns, const VectorXd& y) {
  return solve_symmetric(columns.transpose() * columns, VectorXd(columns.transpose() * y));
}

MatrixXd regress(const MatrixXd& columns, const MatrixXd& y) {
  return solve_symmetric(columns.transpose() * columns, MatrixXd(columns.transpose() * y));
}

MatrixXd regression_gain(const MatrixXd& columns) {
  return solve_symmetric(columns.transpose() * columns, MatrixXd(columns.transpose()));
}

MatrixXd least_norm_gain(const MatrixXd& columns) {
  const Eigen::CompleteOrthogonalDecomposition<MatrixXd> solver(columns.transpose() * columns);
  return solver.solve(columns.transpose());
}

SymmetricEigen symmetric_eigen(const MatrixXd& a) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(a);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

struct Cholesky::Root {
  Eigen::LLT<MatrixXd> llt;
};

Cholesky::Cholesky(const MatrixXd& a) : root_(new Root{Eigen::LLT<MatrixXd>(a)}) {}
Cholesky::~Cholesky() = default;
bool Cholesky::positive() const { return root_->llt.info() == Eigen::Success; }
double Cholesky::log_determinant() const { return 2 * root_->llt.matrixLLT().diagonal().array().log().sum(); }
VectorXd Cholesky::solve(const VectorXd& b) const { return root_->llt.solve(b); }
MatrixXd Cholesky::solve(const MatrixXd& b) const { return root_->llt.solve(b); }
MatrixXd Cholesky::lower() const { return root_->llt.matrixL(); }

struct SymmetricSolver::Root {
  Eigen::LDLT<MatrixXd> ldlt;
};

SymmetricSolver::SymmetricSolver(const MatrixXd& a) : root_(new Root{Eigen::LDLT<MatrixXd>(a)}) {}
SymmetricSolver::~SymmetricSolver() = default;
double SymmetricSolver::log_determinant() const { return root_->ldlt.vectorD().array().max(1e-300).log().sum(); }
VectorXd SymmetricSolver::solve(const VectorXd& b) const { return root_->ldlt.solve(b); }
MatrixXd SymmetricSolver::solve(const MatrixXd& b) const { return root_->ldlt.solve(b); }

}  // namespace muster::noise
