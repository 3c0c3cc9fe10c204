#include "diagnosis/inference/assess/parameter_uncertainty.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "diagnosis/inference/assess/coefficient_covariance.hpp"
#include "diagnosis/inference/assess/posterior_sampler.hpp"
#include "diagnosis/inference/noise/columns.hpp"
#include "diagnosis/inference/score/importance_weights.hpp"
#include "diagnosis/inference/score/marginal_p_value.hpp"
#include "diagnosis/inference/thresholds.hpp"

namespace muster::inference {
namespace {

constexpr int kept = 400;  // thetas

// Ratio of the sandwich variance to the fitted one: scores summed over cells of places (Liang and Zeger 1986).
double by_scatter(const ModelState& state, const WhitenedModel& rest, const ConditionalFit& fitted) {
  const double side = state.time_unit() > 0 ? 1.0 : std::max(1.0, state.fit.covariance.decorrelation());
  const noise::Sites& sites = state.field().sites();
  const Eigen::VectorXd residual = rest.at.residual - fitted.columns * fitted.coefficients;
  std::map<std::tuple<int, long, long>, Eigen::VectorXd> scores;
  for (Index i = 0; i < residual.size(); ++i) {
    const std::tuple cell(sites.group[static_cast<std::size_t>(i)], std::lround(std::floor(sites.place(0, i) / side)),
                          std::lround(std::floor(sites.place(1, i) / side)));
    Eigen::VectorXd& score = scores.try_emplace(cell, Eigen::VectorXd::Zero(fitted.columns.cols())).first->second;
    score += residual[i] * fitted.columns.row(i).transpose();
  }
  Eigen::MatrixXd meat = Eigen::MatrixXd::Zero(fitted.columns.cols(), fitted.columns.cols());
  double squares = 0, fourths = 0;
  for (const auto& [cell, score] : scores) {
    meat += score * score.transpose();
    squares += score.squaredNorm();
    fourths += score.squaredNorm() * score.squaredNorm();
  }
  if (squares * squares < thresholds::fewest_cells * fourths)
    return 1;  // a few cells hold most of it: too few for an estimate
  return (fitted.covariance * meat * fitted.covariance).trace() / fitted.covariance.trace();
}

}  // namespace

ParameterUncertainty parameter_uncertainty(const ModelState& state, const Term& term) {
  const WhitenedModel rest = state.whitened_model(state.design_without(term));
  const ConditionalFit fitted(rest, term.columns, term.candidate->design.whole);
  const Index width = term.columns.cols();
  const Eigen::MatrixXd known = coefficient_covariance(state, noise::hstack(state.design_without(term), term.columns))
                                    .bottomRightCorner(width, width);
  const double overstated = std::max(1.0, known.trace() / fitted.covariance.trace());
  const double grown = std::max(overstated, by_scatter(state, rest, fitted));
  ParameterUncertainty result{{term.theta}, grown * fitted.covariance};
  if (!term.candidate->refinement.any() || term.smooth()) return result;
  const LikelyThetas likely = sample_posterior(state, rest, term, overstated);
  Eigen::MatrixXd within = 0 * fitted.covariance, between = within;
  for (std::size_t k = 0; k < likely.thetas.size(); ++k) {
    const double weight = likely.weights[static_cast<Index>(k)];
    const Eigen::VectorXd off = likely.explained[k].coefficients - fitted.coefficients;
    within += weight * likely.explained[k].covariance;
    between += weight * off * off.transpose();
  }
  result.thetas.clear();
  for (const std::size_t k : resampled(likely.weights, kept)) result.thetas.push_back(likely.thetas[k]);
  result.coefficients = grown * within + between;
  return result;
}

Eigen::VectorXd middle_of(const ModelState& state, const Term& term, const ParameterUncertainty& spread) {
  constexpr std::size_t tries = 40;
  const Candidate& c = *term.candidate;
  const WhitenedModel rest = state.whitened_model(state.design_without(term));
  const double best = ConditionalFit(rest, term.columns, c.design.whole).gain;
  std::vector<Eigen::VectorXd> thetas{term.theta};
  const std::size_t every = spread.thetas.size() / tries + 1;
  for (std::size_t k = 0; k < spread.thetas.size(); k += every) thetas.push_back(spread.thetas[k]);
  Eigen::MatrixXd effects(rest.at.residual.size(), static_cast<Index>(thetas.size()));
  std::vector<bool> explains(thetas.size());
  for (std::size_t k = 0; k < thetas.size(); ++k) {
    const ConditionalFit there(rest, state.columns_of(c, thetas[k]), c.design.whole);
    effects.col(static_cast<Index>(k)) = there.columns * there.coefficients;
    explains[k] = there.gain > best - thresholds::middle_deviance;
  }
  const Eigen::VectorXd mean = effects.rightCols(effects.cols() - 1).rowwise().mean();
  const Eigen::VectorXd off = (effects.colwise() - mean).colwise().squaredNorm();
  std::size_t middle = 0;
  for (std::size_t k = 1; k < thetas.size(); ++k)
    if (explains[k] && off[static_cast<Index>(k)] < off[static_cast<Index>(middle)]) middle = k;
  return thetas[middle];
}

}  // namespace muster::inference
