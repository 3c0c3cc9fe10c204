// Power in the air other than frames: its schedule, and the part of it in a receiver's band.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "medium/time.hpp"

namespace muster::medium {

struct Band {
  double low = 0, high = 0;  // Hz
};

// Fraction of a flat spectrum within a receiver's band.
inline double share_of(const Band& spectrum, const Band& receiver) {
  if (spectrum.low == spectrum.high) return receiver.low <= spectrum.low && spectrum.low < receiver.high;
  const double common = std::min(spectrum.high, receiver.high) - std::max(spectrum.low, receiver.low);
  return std::max(0.0, common) / (spectrum.high - spectrum.low);
}

// On for the first part of each period. A fixed schedule, so results do not depend on the division into ticks.
struct Pulses {
  Time period = 1, on = 1, phase = 0;

  Time on_between(Time from, Time until) const { return on_since_phase(until) - on_since_phase(from); }
  // The next time after this one at which it switches.
  Time next_switch(Time after) const {
    if (on == period) return never;
    const Time into = after - phase - begun(after) * period;
    return after - into + (into < on ? on : period);
  }

 private:
  Time begun(Time at) const {  // whole periods since the phase, rounded down
    const Time t = at - phase;
    return t / period - (t % period < 0);
  }
  Time on_since_phase(Time at) const { return begun(at) * on + std::min(on, at - phase - begun(at) * period); }
};

struct Jammer {
  std::size_t radio = 0;  // that emits it
  Band band;
  Pulses pulses;
  std::vector<double> power;  // mW at each radio while it is on, over its whole band
};

}  // namespace muster::medium
