// The lattice of 2^-12 m for radio geometry, and the one predicate that decides every crossing.
//
// Within 1 km a coordinate is an integer below 2^22, so an orientation is one below 2^48: exact with every compiler.
#pragma once

#include <cmath>
#include <cstdint>
#include <utility>

namespace muster::scene {

constexpr double steps_per_metre = 4096;
constexpr double extent = 1000;   // m; coordinates of walls, and of points on the lattice, are smaller in magnitude
constexpr double reach = 100000;  // m; a radio's coordinates are at most this: links are cut to the extent

// False for NaN and infinity too.
inline bool within_extent(double metres) { return std::abs(metres) < extent; }

inline bool within_reach(double metres) { return std::abs(metres) <= reach; }

// Holds products of three coordinates or more: below 2^73.
__extension__ using Wide = __int128;

// The lattice step nearest to a length or coordinate within the extent, of two the one farther from 0. Equals
// std::llround(), without its function call.
inline std::int64_t snap(double metres) {
  const double steps = metres * steps_per_metre;
  const auto whole = static_cast<std::int64_t>(steps);
  const double rest = steps - static_cast<double>(whole);
  return whole + (rest >= 0.5) - (rest <= -0.5);
}

// A point of the plan, in lattice steps.
struct Spot {
  std::int64_t x = 0, y = 0;
};

// Twice the signed area of the triangle a, b, c: positive where c lies to the left of a -> b.
inline std::int64_t orientation(const Spot& a, const Spot& b, const Spot& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// The half-open rule: an orientation of zero counts as left.
//
// Links run northward and walls southward (below). With these orders, unique up to symmetry, the rule equals a symbolic
// perturbation: every radio moved an infinitesimal step to the east and a far smaller one to the north.
inline bool is_right(std::int64_t orientation_value) { return orientation_value < 0; }

// The canonical order of a link's ends: from south to north; if level, from east to west.
inline bool runs_northward(const Spot& from, const Spot& to) { return from.y != to.y ? from.y < to.y : from.x >= to.x; }

// The canonical order of a wall's ends, the opposite one.
inline bool runs_southward(const Spot& from, const Spot& to) { return runs_northward(to, from); }

// A link in plan, its ends in canonical order.
struct Span {
  Spot from, to;
};

}  // namespace muster::scene
