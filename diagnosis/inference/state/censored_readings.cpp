// Levels that stand for censored readings in a search (inference/noise/censored_draws.hpp).
#include <algorithm>

#include "diagnosis/inference/noise/censored_draws.hpp"
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

void ModelState::draw_censored() {
  const noise::Bounds& bounds = problem_.bounds;
  const Eigen::MatrixXd at_readings = design_of_readings(), at_rows = design();
  const noise::Whitener whitener = whitener_at(fit.covariance);
  const noise::CensoredDraws draws(problem_.measured, bounds, rows_, field_, whitener);
  const noise::Basis basis = noise::whitened(whitener, y_, at_rows, options_.prior).basis;
  Eigen::VectorXd mean;
  for (uint64_t k = 0; k < thresholds::sweeps_of_censored; ++k) {
    mean = at_readings * basis.coefficients(basis.q.transpose() * whitener(y_).col(0), at_rows.cols());
    for (Index i = 0; k == 0 && i < errors_of_draws_.size(); ++i) {  // a new mean moves the draws along
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

void ModelState::fit_to_draws() {
  for (int round = 0; round < thresholds::rounds_of_censored; ++round) {
    draw_censored();
    refit();
  }
}

}  // namespace muster::inference
