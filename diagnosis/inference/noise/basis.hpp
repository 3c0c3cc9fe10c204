// Orthonormal basis of given columns, in their order; columns that earlier ones explain are left out.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace muster::noise {

// Many columns, stored row by row.
using Sheet = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

struct Basis {
  Eigen::MatrixXd q;  // orthonormal
  Eigen::MatrixXd r;  // upper triangle: the kept columns are q r
  std::vector<Eigen::Index> kept;

  double log_determinant() const { return r.diagonal().array().log().sum(); }
  // Residual of x: x less its projection on the basis.
  Eigen::MatrixXd rest(const Eigen::Ref<const Eigen::MatrixXd>& x) const { return x - q * (q.transpose() * x); }
  // The same in place, for many columns.
  void take_out_of(Sheet& x) const;
  // Coefficients of the given columns; zero where one was left out. `explained` = q^T y.
  Eigen::VectorXd coefficients(const Eigen::VectorXd& explained, Eigen::Index columns) const;
  // Covariance of the coefficients for unit variance; zero where a column was left out.
  Eigen::MatrixXd uncertainty(Eigen::Index columns) const;
};

Basis basis_of(const Eigen::Ref<const Eigen::MatrixXd>& columns);

}  // namespace muster::noise
