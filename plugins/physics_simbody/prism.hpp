// A box, or the prism around a cylinder, as the sum of segments.
#pragma once

#include <cmath>

#include "narrow_phase.hpp"

namespace muster::simbody {

constexpr int most_sides = 8;  // pairs of opposite sides of a cylinder's prism
constexpr int most_corners = 2 * most_sides;

// A polygon of a face, in order around its normal, with a mark for each corner.
struct Polygon {
  static constexpr int room = 2 * most_corners;  // a side that clips a convex polygon adds one corner at most

  int count = 0;
  std::array<Eigen::Vector3d, room> corner;
  std::array<int, room> mark;

  void add(const Eigen::Vector3d& p, int m) {
    if (count == room) return;
    corner[count] = p;
    mark[count++] = m;
  }
};

// A box or a cylinder as a Minkowski sum of segments: its sides' half edges, in order of angle, and finally its axis.
// The rest of a prism derives from them: its width along any direction, its faces (each spanned by one side and the
// axis, or normal to the axis), its edges.
struct Prism {
  // The middle of one side of a cylinder's prism is towards `place`, on the circle itself.
  Prism(const Solid& solid, const Eigen::Vector3d& place) : centre(solid.centre) {
    if (solid.kind == Solid::Kind::box) {
      sides = 2;
      for (int i = 0; i < 3; ++i) set(i, solid.axes.col(i), solid.half[i]);
      return;
    }
    constexpr double pi = 3.141592653589793;
    static const double half_side = std::tan(pi / most_corners);  // of a circle of radius 1
    static const std::array<std::array<double, 2>, most_sides> circle = [] {
      std::array<std::array<double, 2>, most_sides> result{};
      for (int i = 0; i < most_sides; ++i) result[i] = {std::cos(i * pi / most_sides), std::sin(i * pi / most_sides)};
      return result;
    }();
    sides = most_sides;
    const Eigen::Vector3d axis = solid.axes.col(2);
    Eigen::Vector3d outward = place - centre;
    outward -= axis.dot(outward) * axis;
    const double distance = outward.norm();
    outward = distance > 1e-6 ? Eigen::Vector3d(outward / distance) : Eigen::Vector3d(solid.axes.col(0));
    const Eigen::Vector3d along = axis.cross(outward);
    for (int i = 0; i < sides; ++i) set(i, circle[i][0] * along - circle[i][1] * outward, half_side * solid.half[0]);
    set(sides, axis, solid.half[2]);
  }

  void set(int i, const Eigen::Vector3d& direction, double length) {
    way[i] = direction;
    half[i] = length;
  }
  const Eigen::Vector3d& edge(int i) const { return way[i]; }
  Eigen::Vector3d half_edge(int i) const { return half[i] * edge(i); }
  int edges() const { return sides + 1; }
  int faces() const { return sides + 1; }
  // Normal of one of a pair of opposite faces: first those along a side, finally those across the axis.
  Eigen::Vector3d normal(int face) const { return face < sides ? edge(face).cross(edge(sides)) : edge(sides); }

  double half_width(const Eigen::Vector3d& n) const {
    double sum = 0;
    for (int i = 0; i < edges(); ++i) sum += half[i] * std::abs(n.dot(edge(i)));
    return sum;
  }
  // The farthest point along n; of edges normal to n (`but`, `but_too`), the middle.
  Eigen::Vector3d farthest(const Eigen::Vector3d& n, int but = -1, int but_too = -1) const {
    Eigen::Vector3d p = centre;
    for (int i = 0; i < edges(); ++i) {
      if (i != but && i != but_too) p += std::copysign(1.0, n.dot(edge(i))) * half_edge(i);
    }
    return p;
  }

  Polygon face(int f, const Eigen::Vector3d& n) const {
    Polygon polygon;
    if (f < sides) {
      const Eigen::Vector3d middle = farthest(n, f, sides), u = half_edge(f), v = half_edge(sides);
      polygon.add(middle + u + v, 0);
      polygon.add(middle - u + v, 1);
      polygon.add(middle - u - v, 2);
      polygon.add(middle + u - v, 3);
    } else {
      Eigen::Vector3d p = centre + std::copysign(1.0, n.dot(edge(sides))) * half_edge(sides);
      for (int i = 0; i < sides; ++i) p += half_edge(i);
      for (int k = 0; k < 2 * sides; ++k) {
        polygon.add(p, k);
        p += (k < sides ? -2 : 2) * half_edge(k % sides);
      }
    }
    return polygon;
  }

  int face_towards(const Eigen::Vector3d& n) const {
    int best = 0;
    double most = -1;
    for (int f = 0; f < faces(); ++f) {
      const double along = std::abs(n.dot(normal(f)));
      if (along > most) most = along, best = f;
    }
    return best;
  }

  int sides;
  Eigen::Vector3d centre;
  std::array<Eigen::Vector3d, most_sides + 1> way;  // unit: separate from lengths, which may be zero
  std::array<double, most_sides + 1> half;
};

}  // namespace muster::simbody
