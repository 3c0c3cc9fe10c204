#include "diagnosis/inference/assess/coefficient_covariance.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "diagnosis/inference/noise/exact_covariance.hpp"

namespace muster::inference {
namespace {

constexpr int noise_draws = 12;

// With the fitted noise, under the exact covariance.
Eigen::MatrixXd exact(const ModelState& state, const WhitenedModel& model, Index columns) {
  const noise::Basis& basis = model.at.basis;
  const Eigen::MatrixXd scatter = noise::scatter_of(state.field(), model.whitener, basis.q);
  const Eigen::MatrixXd unit = Eigen::MatrixXd::Identity(basis.r.rows(), basis.r.rows()),
                        inverse = basis.r.triangularView<Eigen::Upper>().solve(unit);
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(columns, columns);
  result(basis.kept, basis.kept) = inverse * scatter * inverse.transpose();
  return result;
}

// Additional covariance from the uncertain noise, by Vecchia's approximation.
Eigen::MatrixXd by_noise(const ModelState& state, const Eigen::MatrixXd& design, const WhitenedModel& fitted) {
  const Index columns = design.cols();
  const noise::Prior& prior = state.options().prior;
  std::vector<double> weights;
  std::vector<Eigen::VectorXd> means;
  std::vector<Eigen::MatrixXd> covariances;
  for (const noise::Draw& draw : noise::draws(state.fit, noise_draws, state.options().seed)) {
    if (draw.theta != prior.inside(draw.theta)) continue;
    const WhitenedModel model = state.whitened_model(design, {state.fit.covariance.family, draw.theta});
    weights.push_back(state.fit.value - model.at.value - draw.log_density);
    means.push_back(model.coefficients(columns));
    covariances.push_back(model.at.basis.uncertainty(columns));
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

Eigen::MatrixXd coefficient_covariance(const ModelState& state, const Eigen::MatrixXd& design) {
  const WhitenedModel model = state.whitened_model(design);
  const Eigen::MatrixXd known = exact(state, model, design.cols()), more = by_noise(state, design, model);
  // Uncertain noise never reduces a variance.
  const Eigen::ArrayXd own = known.diagonal(), ratio = (own > 0).select(more.diagonal().array() / own, 0);
  const Eigen::VectorXd grown = (1 + ratio.max(0)).sqrt();
  return grown.asDiagonal() * known * grown.asDiagonal();
}

double taken_up_by_fit(const ModelState& state, const Eigen::MatrixXd& design, const WhitenedModel& model) {
  const Eigen::MatrixXd x = state.rows().by_stream(design);
  const Eigen::VectorXd share = (x * model.at.basis.uncertainty(design.cols())).cwiseProduct(x).rowwise().sum();
  return share.dot(state.rows().count()) / state.rows().count().sum();
}

}  // namespace muster::inference
