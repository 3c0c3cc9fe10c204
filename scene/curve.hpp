// Order of points of the plan along a Hilbert curve: neighbours on the curve are near each other.
#pragma once

#include <cstdint>

#include "scene/lattice.hpp"

namespace muster::scene {

// The place of a point on a curve through 2^16 x 2^16 cells of 31 mm, which fill the extent.
inline std::uint32_t place_on_curve(const Spot& spot) {
  constexpr std::int64_t half = std::int64_t{1} << 22;  // lattice steps: more than the extent
  auto x = static_cast<std::uint32_t>(spot.x + half) >> 7, y = static_cast<std::uint32_t>(spot.y + half) >> 7;
  std::uint32_t place = 0;
  for (std::uint32_t side = 1u << 15; side != 0; side >>= 1) {
    const bool right = x & side, up = y & side;
    place = place << 2 | (3u * right ^ static_cast<std::uint32_t>(up));
    if (!up) {  // the curve in this quarter is transposed
      if (right) {
        x = ~x;
        y = ~y;
      }
      const std::uint32_t kept = x;
      x = y;
      y = kept;
    }
  }
  return place;
}

}  // namespace muster::scene
