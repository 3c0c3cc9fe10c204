// Courses in time that levels of all radios, of one, or of what one sends can take. Seconds, decibels, radians.
#pragma once

#include <cmath>

#include "link_term.hpp"

namespace muster {

// rate x s (1 - exp(-u / s)), u being the time since `start` (0 before it) and s = settling; rate in dB/h.
inline double drifted(double rate, double settling, double start, double t) {
  return -rate / 3600 * settling * std::expm1(-std::max(t - start, 0.0) / settling);
}

inline double jumped(double at, double size, double t) { return t >= at ? size : 0; }

inline double swung(double amplitude, double period, double phase, double t) {
  return amplitude * std::cos(full_turn * t / period - phase);
}

}  // namespace muster
