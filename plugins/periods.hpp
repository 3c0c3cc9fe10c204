// What is done once a period, whatever the tick.
#pragma once

#include <cmath>

namespace muster {

// How many periods are over at a time; sums of ticks are forgiven a part in 1e9.
inline double periods_in(double time, double period) { return std::floor(time / period + 1e-9); }

// Whether a multiple of `period` lies in (time - dt, time].
inline bool is_due(double time, double dt, double period) {
  return periods_in(time, period) > periods_in(time - dt, period);
}

}  // namespace muster
