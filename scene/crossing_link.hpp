// Exact data of a crossing: a link in whole lattice steps, and its height in a wall's plane.
#pragma once

#include "scene/walls.hpp"

namespace muster::scene {

struct LatticePoint {
  Spot spot;
  std::int64_t z = 0;
};

inline Vector vector(const LatticePoint& point) { return {point.spot.x, point.spot.y, point.z}; }

// Throws std::runtime_error where the point lies beyond 1 km.
LatticePoint snapped(const Point& point);

// A link with its ends in canonical order, so that p -> q and q -> p are one link.
struct Scene::Link {
  Span span;
  std::int64_t from_z = 0, to_z = 0;
  bool turned = false;

  Link(const LatticePoint& p, const LatticePoint& q) : turned(!runs_northward(p.spot, q.spot)) {
    span = turned ? Span{q.spot, p.spot} : Span{p.spot, q.spot};
    from_z = turned ? q.z : p.z;
    to_z = turned ? p.z : q.z;
  }
};

// A crossing before its conversion to metres: `from` and `to` are the orientations of the link's ends about the wall.
struct Scene::Hit {
  int wall = 0;
  int door = -1;
  int material = 0;
  std::int64_t from = 0, to = 0;

  // The link's height above `height` where it crosses, times |to - from|: below 2^73, so its sign is exact.
  Wide height_above(const Link& link, std::int64_t height) const {
    const Wide sum = Wide{link.from_z - height} * to - Wide{link.to_z - height} * from;
    return to > from ? sum : -sum;
  }
};

}  // namespace muster::scene
