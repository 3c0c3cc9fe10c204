// The random numbers of a pair of radios, in either order, and of one reading between them.
#pragma once

#include <algorithm>
#include <cstring>
#include <muster/plugin.hpp>

namespace muster {

inline uint64_t pair_key(const Step& k, double radio, double other) {
  const uint64_t a = k.key("radio", static_cast<std::size_t>(radio)),
                 b = k.key("radio", static_cast<std::size_t>(other));
  return combined(std::min(a, b), std::max(a, b));
}

inline uint64_t time_key(double t) {
  uint64_t bits;
  std::memcpy(&bits, &t, sizeof bits);
  return bits;
}

}  // namespace muster
