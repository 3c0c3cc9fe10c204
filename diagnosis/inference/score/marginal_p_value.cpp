#include "diagnosis/inference/score/marginal_p_value.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "diagnosis/inference/noise/columns.hpp"
#include "diagnosis/inference/score/other_families.hpp"
#include "diagnosis/inference/state/null_tail.hpp"
#include "diagnosis/inference/thresholds.hpp"

namespace muster::inference {
namespace {

// log of the weighted mean of exp(values); weights by their logarithms.
double log_average(const std::vector<double>& log_weights, const std::vector<double>& values) {
  const double top_weight = *std::max_element(log_weights.begin(), log_weights.end());
  const double top = *std::max_element(values.begin(), values.end());
  double sum = 0, weights = 0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const double weight = std::exp(log_weights[k] - top_weight);
    weights += weight;
    sum += weight * std::exp(values[k] - top);
  }
  return top + std::log(std::max(sum / weights, 1e-300));
}

// Average over draws of theta in one family, weighted by the restricted posterior with the columns inside.
double over_draws(const ModelState& state, const noise::Fit& fit, const Eigen::MatrixXd& design,
                  const Eigen::MatrixXd& columns, double log_tests) {
  const Eigen::MatrixXd both = noise::hstack(design, columns);
  const noise::Prior& prior = state.options().prior;
  std::vector<double> log_weights, log_p;
  for (const noise::Draw& draw : noise::draws(fit, state.options().draws, state.options().seed)) {
    if (draw.theta != prior.inside(draw.theta)) continue;
    const WhitenedModel model = state.whitened_model(both, {fit.covariance.family, draw.theta});
    double gain = 0;
    Index width = 0;
    for (std::size_t k = 0; k < model.at.basis.kept.size(); ++k) {
      if (model.at.basis.kept[k] < design.cols()) continue;
      gain += std::pow(model.at.basis.q.col(static_cast<Index>(k)).dot(model.at.y), 2);
      ++width;
    }
    log_weights.push_back(fit.value - model.at.value - draw.log_density);
    log_p.push_back(width ? std::min(0.0, log_tests + log_tail(gain, static_cast<double>(width))) : 0.0);
  }
  return log_p.empty() ? 0 : log_average(log_weights, log_p);
}

}  // namespace

double log_tests(const ModelState& state, const Candidate& candidate) {
  return state.log_effective_tests(candidate) + candidate.refinement.charge -
         (candidate.design.sign ? std::log(2.0) : 0);
}

double marginal_log_p(const ModelState& state, const noise::Fit& fit, const Eigen::MatrixXd& design,
                      const Eigen::MatrixXd& columns, double log_tests) {
  return over_draws(state, fit, design, columns, log_tests);
}

double marginal_log_p_elsewhere(const ModelState& state, const noise::Fit& fit, const Eigen::MatrixXd& design,
                                const Eigen::MatrixXd& columns, double log_tests, double decided) {
  double log_p = -std::numeric_limits<double>::infinity();
  for (const noise::Fit& other : other_families(state.families, fit.covariance.family)) {
    if (log_p > decided) break;
    if (other.value > state.families[0].value + thresholds::hopeless_start_nats) continue;
    const noise::Fit refit = state.fitted(noise::hstack(design, columns), other.covariance, 6);
    if (refit.value > fit.value + thresholds::excluded_nats) continue;
    log_p = std::max(log_p, over_draws(state, refit, design, columns, log_tests));
  }
  return log_p;
}

}  // namespace muster::inference
