// Readings of which only a bound is known (clipped at the top or bottom code, or lost below the floor): replaced by
// what is expected of them beyond the bound, mean and spread refitted in turn (Tobin 1958; EM of Dempster, Laird, Rubin
// 1977).
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace muster::noise {

// What a reading says of the level: the level itself, that it lies at or below the reading, or at or above it.
enum class Known : uint8_t { value = 1, below, above };

struct Bounds {
  std::vector<Known> known;  // one a reading; empty: all are values
  double half_code = 0.5;    // dB: a bound's code stands for levels up to half a step beyond it

  bool any() const;
  bool is_bound(std::size_t i) const { return !known.empty() && known[i] != Known::value; }
};

// Readings with bounds replaced, for a mean that is linear in the columns of `design` (one row a reading).
Eigen::VectorXd imputed(const Eigen::VectorXd& readings, const Bounds& bounds, const Eigen::MatrixXd& design,
                        int rounds);

}  // namespace muster::noise
