#include "diagnosis/inference/select/fit_beside.hpp"

#include "diagnosis/inference/thresholds.hpp"

namespace muster::inference {

noise::Fit fit_beside(const ModelState& state, const ScoredCandidate& lead, const Eigen::MatrixXd& both) {
  const bool large = lead.columns.cols() > thresholds::large_width || lead.gain > thresholds::large_gain;
  noise::Fit fit = state.fitted(both, state.fit.covariance, large ? 14 : 6);
  if (lead.gain <= thresholds::afresh_gain) return fit;
  const auto start = noise::default_start(state.y(), both, fit.covariance.family);
  const noise::Fit fresh = state.fitted(both, start, 20);
  return fresh.value < fit.value ? fresh : fit;
}

}  // namespace muster::inference
