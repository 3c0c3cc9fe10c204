// Switching functions: link strength to speed along the roadmap.
#pragma once

#include <algorithm>
#include <cmath>

namespace muster {

enum class Switching { linear = 0, tanh, relay, hysteresis };  // in the order of the parameter's choices

// From -1 (back) to 1 (on), zero at excess 0; `excess` is the link's level above the threshold, in widths.
inline double switched(Switching kind, double excess) {
  switch (kind) {
    case Switching::linear:
    case Switching::hysteresis:
      return std::clamp(excess, -1.0, 1.0);
    case Switching::tanh:
      return std::tanh(excess);
    case Switching::relay:
      return std::abs(excess) < 0.5 ? 0.0 : std::copysign(1.0, excess);
  }
  return 0;
}

// What hysteresis makes of it: once the link was below the threshold, the robot only goes back to it, and on again when
// the link is a whole width above. Where a wall makes the link jump across the threshold, it rests on the near side.
inline double after_turning(double on, double excess, bool& has_turned) {
  if (excess < 0) has_turned = true;
  if (excess >= 1) has_turned = false;
  return has_turned ? std::min(on, 0.0) : on;
}

// From 0 while the child's link is `margin` [dB] or more above the threshold, to 1 at half of that: a follower rests
// until it is needed, and is fully released long before the threshold.
inline double wanted(double excess_db, double margin) { return std::clamp(2 * (1 - excess_db / margin), 0.0, 1.0); }

// First-order low-pass filter with `time_constant`; `since` is the time from the reading before [s].
inline double smoothed(double before, double reading, double since, double time_constant) {
  const double weight = time_constant > 0 ? 1 - std::exp(-since / time_constant) : 1;
  return before + weight * (reading - before);
}

}  // namespace muster
