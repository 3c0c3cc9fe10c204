// The work that physics engines are compared on: robots that speed up to their own pace, turn on an arc, and half way
// through turn the other way.
#pragma once

#include <cmath>

namespace muster::bench {

constexpr double wheel_radius = 0.05, half_base = 0.105;  // of the Scarab [m]
constexpr double apart = 12;                              // from robot to robot [m]
constexpr double until = 10;                              // [s]

inline double ramp(double t, double from, double to) { return t <= from ? 0 : t >= to ? 1 : (t - from) / (to - from); }

struct Arc {
  double x, y, heading;  // at the start
  double pace, turn;     // [m/s], [rad/s]

  double v(double t) const { return pace * ramp(t, 0.5, 1); }
  double w(double t) const { return turn * (ramp(t, 0.5, 1) - 2 * ramp(t, 5, 5.5)); }
  double left(double t) const { return (v(t) - w(t) * half_base) / wheel_radius; }
  double right(double t) const { return (v(t) + w(t) * half_base) / wheel_radius; }
};

// Linear over a step: the rate at its start, and the slope.
struct Rated {
  double rate, slope;  // [rad/s], [rad/s2]
};
inline Rated rated(double begin, double end, double h) { return {begin, (end - begin) / h}; }

inline Arc arc(int robot) {
  constexpr int row = 8;
  return {apart * (robot % row), apart * std::floor(robot / static_cast<double>(row)),
          6.283185307179586 * std::fmod(0.618034 * robot, 1.0), 0.3 + 0.02 * (robot % 11),
          (robot % 2 ? 1 : -1) * (0.3 + 0.05 * (robot % 7))};
}

}  // namespace muster::bench
