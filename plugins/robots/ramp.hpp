// Limits of a pair of wheels. Both wheels are scaled alike, so a command beyond the limits keeps its turning radius.
#pragma once

#include <algorithm>
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

}  // namespace muster
