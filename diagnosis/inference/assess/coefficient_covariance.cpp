#include "diagnosis/inference/assess/coefficient_covariance.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "diagnosis/inference/noise/exact_covariance.hpp"

namespace muster::inference {
namespace {

constexpr int noise_draws = 12;

// Under the covariance itself.
Eigen::MatrixXd exact(const Bench& bench, const Stand& stand, Index columns) {
  const noise::Basis& basis = stand.at.basis;
  const Eigen::MatrixXd scatter = noise::scatter_of(bench.field(), stand.whitener, basis.q);
  const Eigen::MatrixXd unit = Eigen::MatrixXd::Identity(basis.r.rows(), basis.r.rows()),
                        inverse = basis.r.triangularView<Eigen::Upper>().solve(unit);
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(columns, columns);
  result(basis.kept, basis.kept) = inverse * scatter * inverse.transpose();
  return result;
}

// What it is more, by Vecchia's approximation, where the noise is not taken as known.
Eigen::MatrixXd by_noise(const Bench& bench, const Eigen::MatrixXd& design, const Stand& fitted) {
  const Index columns = design.cols();
  const noise::Prior& prior = bench.options().prior;
  std::vector<double> weights;
  std::vector<Eigen::VectorXd> means;
  std::vector<Eigen::MatrixXd> covariances;
  for (const noise::Draw& draw : noise::draws(bench.fit, noise_draws, bench.options().seed)) {
    if (draw.theta != prior.inside(draw.theta)) continue;
    const Stand stand = bench.stand(design, {bench.fit.covariance.family, draw.theta});
    weights.push_back(bench.fit.value - stand.at.value - draw.log_density);
    means.push_back(stand.coefficients(columns));
    covariances.push_back(stand.at.basis.uncertainty(columns));
  }
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(columns, columns);
  if (weights.empty()) return result;
  const double top = *std::max_element(weights.begin(), weights.end());
  double sum = 0;
  for (double& w : weights) sum += w = std::exp(w - top);
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(columns);
  for (std::size_t k = 0; k < weights.size(); ++k) mean += weights[k] / sum * means[k];
  for (std::size_t k = 0; k < weights.size(); ++k) {
    const Eigen::VectorXd off = means[k] - mean;
    result += weights[k] / sum * (covariances[k] + off * off.transpose());
  }
  return result - fitted.at.basis.uncertainty(columns);
}

}  // namespace

Eigen::MatrixXd uncertainty_of(const Bench& bench, const Eigen::MatrixXd& design) {
  const Stand stand = bench.stand(design);
  const Eigen::MatrixXd known = exact(bench, stand, design.cols()), more = by_noise(bench, design, stand);
  // No noise that might be makes anything known better than it is by the one that is likeliest.
  const Eigen::ArrayXd own = known.diagonal(), ratio = (own > 0).select(more.diagonal().array() / own, 0);
  const Eigen::VectorXd grown = (1 + ratio.max(0)).sqrt();
  return grown.asDiagonal() * known * grown.asDiagonal();
}

}  // namespace muster::inference
