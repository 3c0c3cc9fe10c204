#include "diagnosis/inference/score/longer_fields.hpp"

#include "diagnosis/inference/noise/columns.hpp"

namespace muster::inference {

std::optional<double> gain_beside_longer(const ModelState& state, const noise::Fit& beside,
                                         const Eigen::MatrixXd& design, const Eigen::MatrixXd& columns) {
  if (!state.options().longer || state.time_unit() > 0 || noise::is_stated(beside.covariance.family)) return {};
  constexpr int steps = 14;
  const auto fitted = [&](const Eigen::MatrixXd& mean_columns) {
    return noise::fit_long_too(state.field(), state.y(), mean_columns, *state.options().longer, beside.covariance,
                               steps);
  };
  const noise::Fit without = fitted(design);
  if (without.covariance.theta[1] <= state.options().prior.upper()[1]) return {};
  const noise::Fit with = fitted(noise::hstack(design, columns));
  return 2 * (with.log_likelihood() - without.log_likelihood());
}

}  // namespace muster::inference
