#include "diagnosis/inference/noise/reml.hpp"

#include "diagnosis/inference/noise/columns.hpp"

namespace muster::noise {
namespace {

struct PriorTerm {
  double offset, precision;
};
PriorTerm on_distance(const Covariance& c, const Prior& p) {
  return {c.theta[1] - p.log_decorrelation - log_scale_of(c.family),
          1 / (p.decorrelation_spread * p.decorrelation_spread)};
}
PriorTerm on_share(const Covariance& c, const Prior& p) {
  return {c.theta[3] - p.logit_shared, 1 / (p.shared_spread * p.shared_spread)};
}

double nats_of(const PriorTerm& term) { return 0.5 * term.precision * term.offset * term.offset; }

}  // namespace

double prior_nats(const Covariance& covariance, const Prior& prior) {
  return nats_of(on_distance(covariance, prior)) + nats_of(on_share(covariance, prior));
}

Whitened whitened(const Whitener& whitener, const Eigen::VectorXd& y, const Eigen::MatrixXd& design,
                  const Prior& prior) {
  const Eigen::MatrixXd both = whitener(hstack(design, y));
  Whitened result{basis_of(both.leftCols(design.cols())), both.rightCols(1), {}, 0};
  result.residual = result.basis.rest(result.y);
  result.value = -whitener.log_scale() + 0.5 * result.residual.squaredNorm() + result.basis.log_determinant() +
                 prior_nats(whitener.covariance(), prior);
  return result;
}

Objective objective(const WhitenerSlopes& slopes, const Eigen::VectorXd& y, const Eigen::MatrixXd& design,
                    const Prior& prior) {
  const Covariance& covariance = slopes.whitener().covariance();
  const Whitened at = whitened(slopes.whitener(), y, design, prior);
  const Basis& basis = at.basis;
  const Eigen::VectorXd beta = basis.coefficients(basis.q.transpose() * at.y, design.cols());
  // Gradients of the residual sum of squares and of the design's determinant: the trace of R^-1 Q^T dW X.
  const Eigen::MatrixXd turned = basis.r.triangularView<Eigen::Upper>().solve(basis.q.transpose()).transpose();
  const Theta of_design =
      slopes.contracted(hstack(design(Eigen::all, basis.kept), y - design * beta), hstack(turned, at.residual));
  Objective result{at.value, of_design - slopes.of_log_scale(), slopes.information(), basis.log_determinant()};
  const PriorTerm distance = on_distance(covariance, prior), share = on_share(covariance, prior);
  result.gradient[1] += distance.precision * distance.offset;
  result.gradient[3] += share.precision * share.offset;
  result.information(1, 1) += distance.precision;
  result.information(3, 3) += share.precision;
  return result;
}

}  // namespace muster::noise
