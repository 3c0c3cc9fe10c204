// Exact test whether a straight link crosses a triangle: the same both ways, and unambiguous for grazing links.
//
// All points are on the lattice of 2^-12 m within 1 km (README.md), so differences are below 2^23 and each determinant
// below 2^73. Ties are broken as for walls, by symbolic perturbation: every radio is moved an infinitesimal step to the
// east, a far smaller one to the north, and a far greater one up. The shift is the same at both ends and for all
// triangles. So a link through an edge or a vertex crosses a closed surface as often as a link beside it.
#pragma once

#include <cstdint>

#include "scene/lattice.hpp"

namespace muster::scene {

// In lattice steps, east, north and up.
struct Vector {
  std::int64_t x, y, z;
};

inline Vector operator-(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

inline Wide dot(const Vector& a, const Vector& b) { return Wide{a.x} * b.x + Wide{a.y} * b.y + Wide{a.z} * b.z; }

// Sign of a value with gradient `growth` in the radios' shift. Zero if the gradient is zero too.
inline int sign(Wide value, const Vector& growth) {
  for (const Wide each : {value, Wide{growth.z}, Wide{growth.x}, Wide{growth.y}}) {
    if (each != 0) return each > 0 ? 1 : -1;
  }
  return 0;
}

struct Triangle {
  Vector a, b, c;

  bool is_crossed(const Vector& p, const Vector& q) const {
    const Vector normal = cross(b - a, c - a);
    const int side = sign(dot(normal, p - a), normal);
    if (side == 0 || side == sign(dot(normal, q - a), normal)) return false;
    const Vector along = q - p;
    const auto passes = [&](const Vector& u, const Vector& v) {  // on which side of an edge
      return sign(dot(along, cross(u - p, v - p)), cross(along, v - u));
    };
    const int first = passes(a, b);
    return first == passes(b, c) && first == passes(c, a);
  }
};

}  // namespace muster::scene
