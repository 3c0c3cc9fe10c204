// Commands towards a place, for a robot on two wheels.
#pragma once

#include <algorithm>
#include <cmath>
#include <muster/tables.hpp>

namespace muster {

struct Turning {
  double gain, most;  // [1/s], [rad/s]

  double rate(double angle) const { return std::clamp(gain * angle, -most, most); }
};

// The shortest turn from one heading to another [rad].
inline double turn_to(double yaw, double from) { return std::remainder(yaw - from, 2 * 3.141592653589793); }

// Turns in proportion to the bearing and drives with its cosine; turns on the spot while the place is behind.
inline Command towards(const Odometry& here, double x, double y, double speed, const Turning& turning) {
  const double bearing = turn_to(std::atan2(y - here.y, x - here.x), here.yaw);
  return {std::max(0.0, speed * std::cos(bearing)), turning.rate(bearing)};
}

}  // namespace muster
