#include "diagnosis/inference/score/importance_weights.hpp"

#include "diagnosis/inference/thresholds.hpp"

namespace muster::inference {

double effective_sample_size(const Eigen::VectorXd& weights) {
  return weights.sum() * weights.sum() / weights.squaredNorm();
}

Eigen::VectorXd tempered(Eigen::VectorXd weights) {
  for (int roots = 0; roots < 10 && effective_sample_size(weights) < thresholds::fewest_effective; ++roots)
    weights = weights.cwiseSqrt();
  return weights / weights.sum();
}

std::vector<std::size_t> resampled(const Eigen::VectorXd& weights, int count) {
  std::vector<std::size_t> result;
  double sum = 0;
  for (Eigen::Index k = 0; k < weights.size(); ++k) {
    sum += count * weights[k];
    while (static_cast<double>(result.size()) + 0.5 < sum) result.push_back(static_cast<std::size_t>(k));
  }
  return result;
}

}  // namespace muster::inference
