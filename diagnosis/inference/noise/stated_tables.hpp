// The stated correlation of all pairs of rows that stand in one neighbourhood. A pair stands in many, and the model
// that states the correlation, which may have to integrate for it, is asked once.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "diagnosis/inference/noise/family.hpp"
#include "diagnosis/inference/noise/row_kernel.hpp"
#include "diagnosis/inference/noise/stated_correlation.hpp"

namespace muster::noise {

// Entries of the stated correlation at one decorrelation distance. Between these it is interpolated, linearly in the
// logarithm, which keeps covariances valid: a mean of two is one.
struct StatedTables {
  static constexpr double step = 0.25;  // of log decorrelation [m]
  struct Position {
    int k;
    double weight;  // of k + 1
  };
  static Position position_of(double log_decorrelation) {
    const double at = log_decorrelation / step, below = std::floor(at);
    return {static_cast<int>(below), at - below};
  }
  // A covariance whose stated correlation is at the nearest tabulated distance: half the tables for what is not fitted.
  static Covariance nearest(Covariance covariance) {
    if (is_stated(covariance.family)) covariance.theta[1] = step * std::round(covariance.theta[1] / step);
    return covariance;
  }
  // Of an entry of the pairs, less than same_site: linear.
  static double correlation_of(std::size_t entry) { return 1 - static_cast<double>(entry) / distances; }

  static uint16_t entry_of(double correlation) {
    return static_cast<uint16_t>(std::clamp((1 - correlation) * distances + 0.5, 0.0, 1.0 * distances));
  }

  std::vector<uint16_t> pairs;
  Eigen::VectorXf own;  // variance at each row over the stated one
};

// The pairs of rows of all neighbourhoods, each once.
class NeighbourPairs {
 public:
  explicit NeighbourPairs(std::size_t slots) : of_slot_(slots, none) {}

  // A slot holds this pair of rows, whose entries are `more` than its correlation says.
  void add(std::size_t slot, Index row, Index other, int more);
  StatedTables tables(const Sites& sites, double decorrelation) const;

 private:
  static constexpr uint32_t none = ~uint32_t{0};

  std::unordered_map<uint64_t, uint32_t> numbers_;  // of pairs, by both rows
  std::vector<uint32_t> lower_, upper_, of_slot_;
  std::vector<uint16_t> more_;
};

}  // namespace muster::noise
