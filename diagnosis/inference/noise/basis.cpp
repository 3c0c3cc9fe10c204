#include "diagnosis/inference/noise/basis.hpp"

#include "diagnosis/inference/noise/row_kernel.hpp"

namespace muster::noise {

constexpr double least_share = 1e-6;  // least share of a column's length that earlier columns must leave of it

Basis basis_of(const Eigen::Ref<const Eigen::MatrixXd>& columns) {
  const Eigen::Index n = columns.cols();
  Basis basis{Eigen::MatrixXd(columns.rows(), n), Eigen::MatrixXd::Zero(n, n), {}};
  Eigen::Index used = 0;
  for (Eigen::Index j = 0; j < n; ++j) {
    Eigen::VectorXd x = columns.col(j);
    const double before = x.norm();
    Eigen::VectorXd along = Eigen::VectorXd::Zero(used);
    for (int pass = 0; pass < 2; ++pass) {  // twice is enough (Giraud, Langou, Rozloznik 2005)
      const Eigen::VectorXd part = basis.q.leftCols(used).transpose() * x;
      x -= basis.q.leftCols(used) * part;
      along += part;
    }
    const double length = x.norm();
    if (!(length > least_share * before)) continue;
    basis.q.col(used) = x / length;
    basis.r.col(used).head(used) = along;
    basis.r(used, used) = length;
    basis.kept.push_back(j);
    ++used;
  }
  basis.q.conservativeResize(Eigen::NoChange, used);
  basis.r.conservativeResize(used, used);
  return basis;
}

void Basis::take_out_of(Sheet& x) const {
  const Sheet by_row = q.cast<float>();
  Eigen::Matrix<float, 32, Eigen::Dynamic> scratch(32, q.cols());
  row_kernels().best().take_out(by_row.data(), q.rows(), q.cols(), x.data(), x.cols(), scratch.data());
}

Eigen::VectorXd Basis::coefficients(const Eigen::VectorXd& explained, Eigen::Index columns) const {
  const Eigen::VectorXd solved = r.triangularView<Eigen::Upper>().solve(explained);
  Eigen::VectorXd result = Eigen::VectorXd::Zero(columns);
  result(kept) = solved;
  return result;
}

Eigen::MatrixXd Basis::uncertainty(Eigen::Index columns) const {
  const Eigen::MatrixXd inverse = r.triangularView<Eigen::Upper>().solve(Eigen::MatrixXd::Identity(r.rows(), r.rows()));
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(columns, columns);
  result(kept, kept) = inverse * inverse.transpose();
  return result;
}

}  // namespace muster::noise
