// Limits of two or four wheels. All are scaled alike, so a command beyond the limits keeps its turning radius and its
// direction.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace muster {

struct WheelRates {
  double left, right;  // [rad/s]
};

inline double largest(const WheelRates& r) { return std::max(std::abs(r.left), std::abs(r.right)); }

// The rates of the same turning radius that no wheel's limit [rad/s] forbids.
inline WheelRates limited(const WheelRates& asked, double most) {
  const double scale = largest(asked) > most ? most / largest(asked) : 1;
  return {asked.left * scale, asked.right * scale};
}

// Rates after a ramp from `from` towards `to` with no wheel changing by more than `most` [rad/s].
inline WheelRates ramped(const WheelRates& from, const WheelRates& to, double most) {
  const WheelRates change = limited({to.left - from.left, to.right - from.right}, most);
  const bool arrives = largest({to.left - from.left, to.right - from.right}) <= most;
  return arrives ? to : WheelRates{from.left + change.left, from.right + change.right};
}

// The same of four wheels.
using FourRates = std::array<double, 4>;  // [rad/s]

inline double largest(const FourRates& r) {
  double most = 0;
  for (const double rate : r) most = std::max(most, std::abs(rate));
  return most;
}

inline FourRates limited(FourRates asked, double most) {
  const double scale = largest(asked) > most ? most / largest(asked) : 1;
  for (double& rate : asked) rate *= scale;
  return asked;
}

inline FourRates ramped(const FourRates& from, const FourRates& to, double most) {
  FourRates change;
  for (std::size_t i = 0; i < 4; ++i) change[i] = to[i] - from[i];
  if (largest(change) <= most) return to;
  change = limited(change, most);
  for (std::size_t i = 0; i < 4; ++i) change[i] += from[i];
  return change;
}

}  // namespace muster
