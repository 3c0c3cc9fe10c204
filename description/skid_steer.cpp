#include <algorithm>
#include <cmath>

#include "description/robot.hpp"

namespace muster::description {

// At a turn rate of 1 rad/s and a speed v of the wheels' rims, a wheel `way` from the middle of its side slips by
// (v - base / 2) along and `way` across; friction has that direction. Its moment about the middle grows with v.
double effective_base(double wheel_base, const std::vector<double>& ways) {
  const double half = wheel_base / 2;
  double farthest = 0;
  for (const double way : ways) farthest = std::max(farthest, std::abs(way));
  if (farthest == 0) return wheel_base;
  const auto moment = [&](double v) {
    double sum = 0;
    for (const double way : ways) {
      const double along = v - half, slip = std::hypot(along, way);
      sum += slip > 0 ? (along * half - way * way) / slip : half;  // a wheel in the middle holds until it slips
    }
    return sum;
  };
  double low = half, high = half + farthest * farthest / half;
  for (int k = 0; k < 200 && low < high; ++k) {
    const double middle = low + (high - low) / 2;
    if (middle == low || middle == high) break;
    (moment(middle) < 0 ? low : high) = middle;
  }
  return 2 * high;
}

}  // namespace muster::description
