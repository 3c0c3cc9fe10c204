// Random draws of one reading, keyed by its two radios, their places and its time, in either order.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstring>
#include <muster/random.hpp>
#include <muster/tables.hpp>

namespace muster {

inline uint64_t bits_of(double value) {
  uint64_t result;
  std::memcpy(&result, &value, sizeof result);
  return result;
}

// One end of a reading.
inline uint64_t end_key(uint64_t radio_key, double t, const Pose& at) {
  uint64_t key = combined(radio_key, bits_of(t));
  for (const double x : {at.x, at.y, at.z}) key = combined(key, bits_of(x));
  return key;
}

// Complex normal of mean power 1, the same for both orders of the ends.
inline std::complex<double> diffuse(const Stream& random, uint64_t end, uint64_t other) {
  const Stream own = random.of(combined(std::min(end, other), std::max(end, other)));
  return std::complex<double>(own.normal(0), own.normal(1)) * std::sqrt(0.5);
}

}  // namespace muster
