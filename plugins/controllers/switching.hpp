// How a robot of a chain turns the strength of its links into speed along the roadmap.
#pragma once

#include <algorithm>
#include <cmath>

namespace muster {

enum class Switching { linear = 0, tanh, relay };  // in the order of the parameter's choices

// From -1 (back) to 1 (on), zero at excess 0; `excess` is how far a link lies above the threshold, in widths.
inline double switched(Switching kind, double excess) {
  switch (kind) {
    case Switching::linear:
      return std::clamp(excess, -1.0, 1.0);
    case Switching::tanh:
      return std::tanh(excess);
    case Switching::relay:
      return std::abs(excess) < 0.5 ? 0.0 : std::copysign(1.0, excess);
  }
  return 0;
}

// From 0 while the child's link lies `margin` [dB] or more above the threshold to 1 at half of that: a follower stays
// where it is until it is needed, and is wholly free long before the threshold.
inline double wanted(double excess_db, double margin) { return std::clamp(2 * (1 - excess_db / margin), 0.0, 1.0); }

// A reading in a first-order filter that forgets with `time_constant`, `since` after the one before [s].
inline double smoothed(double before, double reading, double since, double time_constant) {
  const double weight = time_constant > 0 ? 1 - std::exp(-since / time_constant) : 1;
  return before + weight * (reading - before);
}

}  // namespace muster
