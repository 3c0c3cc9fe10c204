#include "diagnosis/calibration/truncation.hpp"

#include <algorithm>
#include <cmath>

#include "diagnosis/radio/thresholds.hpp"

namespace muster::diagnosis {
namespace {

double below(double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); }

}  // namespace

bool Truncation::is_abrupt() const { return near > thresholds::near_a_floor * expected; }

Truncation truncation_of(const Eigen::VectorXd& heard, const Eigen::VectorXd& mean, const Eigen::VectorXd& sigma,
                         double half_code) {
  Truncation result{.floor = heard.minCoeff()};
  const double end = result.floor - half_code, near = end + thresholds::above_floor;
  for (Eigen::Index i = 0; i < heard.size(); ++i) {
    const double lost = below((end - mean[i]) / sigma[i]), kept = std::max(1 - lost, 1e-12);
    result.evidence -= std::log(kept);
    result.expected += 1 - std::min(below((mean[i] - near) / sigma[i]) / kept, 1.0);
    result.near += heard[i] < near;
  }
  return result;
}

}  // namespace muster::diagnosis
