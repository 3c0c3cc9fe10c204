// Events once a period, for any tick length.
#pragma once

#include <cmath>

namespace muster {

// Number of periods completed at a time; tolerates rounding of summed ticks by a part in 1e9.
inline double periods_in(double time, double period) { return std::floor(time / period + 1e-9); }

// True if a multiple of `period` is in (time - dt, time].
inline bool is_due(double time, double dt, double period) {
  return periods_in(time, period) > periods_in(time - dt, period);
}

// True in an instance's first step of a run, whose time is its period `dt`, every times the tick of the world.
inline bool is_first_step(double time, double dt) { return time < 1.5 * dt; }

}  // namespace muster
