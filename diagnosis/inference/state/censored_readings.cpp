// Levels that stand for censored readings in a search (inference/noise/censored_draws.hpp).
#include <algorithm>
#include <cmath>
#include <vector>

#include "diagnosis/inference/noise/censored_draws.hpp"
#include "diagnosis/inference/noise/columns.hpp"
#include "diagnosis/inference/state/model_state.hpp"
#include "diagnosis/inference/thresholds.hpp"

namespace muster::inference {

void ModelState::impute(int rounds) {
  measured_ = noise::imputed(problem_.measured, problem_.bounds,
                             problem_.bounds.changes() ? design_of_readings() : problem_.base, rounds);
  if (aside_.size() > 0) measured_ -= aside_;
  y_ = rows_.mean(measured_);
  if (!families.empty() && problem_.bounds.any()) draw_censored();
}

void ModelState::draw_about(const std::function<Eigen::VectorXd()>& mean_given_draws, uint64_t sweeps) {
  const noise::Bounds& bounds = problem_.bounds;
  const noise::Whitener whitener = whitener_at(fit.covariance);
  const noise::CensoredDraws draws(problem_.measured, bounds, rows_, field_, whitener);
  Eigen::VectorXd mean;
  for (uint64_t k = 0; k < sweeps; ++k) {
    mean = mean_given_draws();
    for (Index i = 0; k == 0 && i < errors_of_draws_.size(); ++i) {
      const auto at = static_cast<std::size_t>(i);
      const double reading = problem_.measured[i];
      if (bounds.is_bound(at))
        measured_[i] =
            std::clamp(mean[i] + errors_of_draws_[i], bounds.lowest(at, reading), bounds.highest(at, reading));
    }
    draws.sweep(sweeps_++, mean, measured_);
    y_ = rows_.mean(measured_);
  }
  errors_of_draws_ = measured_ - mean;
}

std::function<Eigen::VectorXd()> ModelState::mean_with(const Eigen::MatrixXd& columns) const {
  const Eigen::MatrixXd at_rows = noise::hstack(design(), columns);
  const noise::Basis basis = noise::whitened(whitener_at(fit.covariance), y_, at_rows, options_.prior).basis;
  Eigen::MatrixXd at_readings = design_of_readings();
  for (const auto& column : columns.colwise()) at_readings = noise::hstack(at_readings, rows_.at_readings(column));
  return [this, basis, at_readings] {
    const Eigen::VectorXd whitened = whitener_at(fit.covariance)(y_);
    return Eigen::VectorXd(at_readings * basis.coefficients(basis.q.transpose() * whitened, at_readings.cols()));
  };
}

void ModelState::draw_censored() {
  draw_about(mean_with(Eigen::MatrixXd(rows_.size(), 0)), thresholds::sweeps_of_censored);
}

void ModelState::draw_towards(const Eigen::MatrixXd& columns, bool whole) {
  const Eigen::VectorXd without = mean_with(Eigen::MatrixXd(rows_.size(), 0))();
  const auto given_draws = mean_with(columns);
  draw_about(given_draws, thresholds::sweeps_of_censored);
  const Eigen::VectorXd effect =
      whole ? rows_.at_readings(columns.rowwise().sum()) : Eigen::VectorXd(given_draws() - without);
  double censored = 0;
  for (Index i = 0; i < effect.size(); ++i) {
    if (problem_.bounds.is_bound(static_cast<std::size_t>(i))) censored += effect[i] * effect[i];
  }
  const double known = std::sqrt(std::max(0.0, 1 - censored / std::max(effect.squaredNorm(), 1e-12)));
  const Eigen::VectorXd part_way = without + (whole ? 0.5 : known / (1 + known)) * effect;
  take_typical_draw(part_way, columns);
}

void ModelState::take_typical_draw(const Eigen::VectorXd& mean, const Eigen::MatrixXd& columns) {
  const WhitenedModel model = whitened_model(design());
  const noise::Basis added = noise::basis_of(model.at.basis.rest(model.whitener(columns)));
  constexpr auto count = static_cast<Index>(thresholds::draws_of_a_lead);
  std::vector<Eigen::VectorXd> drawn;
  Eigen::MatrixXd along(added.q.cols(), count);  // of each draw's residual, which the design leaves as it is
  for (Index k = 0; k < count; ++k) {
    draw_about([&] { return mean; }, thresholds::sweeps_of_censored);
    along.col(k) = added.q.transpose() * model.whitener(y_);
    drawn.push_back(measured_);
  }
  const Eigen::VectorXd common = along.rowwise().mean();
  const double scatter = (along.colwise() - common).squaredNorm() / static_cast<double>(count - 1);
  const double typical = std::max(common.squaredNorm() - scatter / static_cast<double>(count), 0.0);
  Index nearest = 0;
  (along.colwise().squaredNorm().array() - typical).abs().minCoeff(&nearest);
  measured_ = drawn[static_cast<std::size_t>(nearest)];
  errors_of_draws_ = measured_ - mean;
  y_ = rows_.mean(measured_);
}

ModelState::Draws ModelState::draws() const { return {measured_, errors_of_draws_, fit}; }

void ModelState::put_back(Draws draws) {
  measured_ = std::move(draws.measured);
  errors_of_draws_ = std::move(draws.errors);
  fit = std::move(draws.fit);
  y_ = rows_.mean(measured_);
}

void ModelState::fit_to_draws() {
  for (int round = 0; round < thresholds::rounds_of_censored; ++round) {
    draw_censored();
    refit();
  }
}

}  // namespace muster::inference
