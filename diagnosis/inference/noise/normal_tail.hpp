// The upper tail of the standard normal distribution.
#pragma once

#include <algorithm>
#include <cmath>

namespace muster::noise {

inline double log_above(double z) { return std::log(0.5 * std::erfc(z / std::sqrt(2.0))); }

// phi(z) / (1 - Phi(z)); its asymptote where the tail would underflow.
inline double hazard(double z) {
  if (z > 30) return z + 1 / z;
  return std::exp(-z * z / 2) / std::sqrt(2 * M_PI) / (0.5 * std::erfc(z / std::sqrt(2.0)));
}

// The variable that lies above `least` and has this log share of all above it. Newton's method on the logarithm, which
// is concave: from any variable above it goes down and never too far.
inline double of_log_share(double log_share, double from, double least) {
  double x = from;
  for (int k = 0; k < 40 && x > least; ++k) {
    const double step = (log_above(x) - log_share) / hazard(x);
    x += step;
    if (std::abs(step) < 1e-9) break;
  }
  return std::max(x, least);
}

}  // namespace muster::noise
