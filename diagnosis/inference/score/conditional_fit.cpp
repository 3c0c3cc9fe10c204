#include "diagnosis/inference/score/conditional_fit.hpp"

namespace muster::inference {

Beside::Beside(const Stand& rest, const Eigen::MatrixXd& plain, bool whole)
    : columns(rest.at.basis.rest(rest.whitener(plain))) {
  const noise::Basis basis = noise::basis_of(columns);
  const Eigen::VectorXd along = basis.q.transpose() * rest.at.residual;
  coefficients = basis.coefficients(along, plain.cols());
  covariance = basis.uncertainty(plain.cols());
  gain = whole ? rest.gain_as_it_is(plain) : along.squaredNorm();
}

}  // namespace muster::inference
