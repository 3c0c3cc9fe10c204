// Shapes in the plan that the world's map lacks, and their intersection with a straight link.
#pragma once

#include <algorithm>
#include <cmath>
#include <muster/tables.hpp>

namespace muster {

// Twice the signed area of a triangle: positive where the point is to the left of a -> b.
inline double side(double ax, double ay, double bx, double by, double x, double y) {
  return (bx - ax) * (y - ay) - (by - ay) * (x - ax);
}

// An upright wall without thickness, from the ground up.
struct Segment {
  double x0, y0, x1, y1;
  double length = std::hypot(x1 - x0, y1 - y0);

  // True if the points are on different sides of the segment's line; never if its length is 0.
  bool parts(const Pose& a, const Pose& b) const {
    return (side(x0, y0, x1, y1, a.x, a.y) > 0) != (side(x0, y0, x1, y1, b.x, b.y) > 0);
  }

  // Share of it that the link from a to b meets, 0 to 1: half where it passes an end, all from edge / 2 further in.
  double share(const Pose& a, const Pose& b, double height, double edge) const {
    if (!parts(a, b)) return 0;
    const double sa = side(x0, y0, x1, y1, a.x, a.y), sb = side(x0, y0, x1, y1, b.x, b.y);
    const double over = std::max(edge, 1e-9), at = sa / (sa - sb);
    const double x = a.x + at * (b.x - a.x), y = a.y + at * (b.y - a.y);
    const double lengthwise = (x - x0) * (x1 - x0) + (y - y0) * (y1 - y0);
    if (lengthwise < -over * length || lengthwise > (length + over) * length)
      return 0;  // a clear miss, as for most links
    const double z = a.z + at * (b.z - a.z);
    if (z < 0 || z >= height) return 0;
    const double along = lengthwise / length;
    const auto inside = [over](double way) { return std::clamp(0.5 + way / over, 0.0, 1.0); };
    return std::max(inside(along) + inside(length - along) - 1, 0.0);
  }
};

// An upright cylinder on the ground.
struct Disk {
  double x, y, radius;

  // Fast test whether the link may pass through, as few do; the same from b to a except within rounding.
  bool may_stop(const Pose& a, const Pose& b) const {
    const double ex = b.x - a.x, ey = b.y - a.y, passes = side(a.x, a.y, b.x, b.y, x, y);
    return passes * passes <= 1.001 * radius * radius * (ex * ex + ey * ey);
  }

  // Length of the link's path through it in plan, in m.
  double way(const Pose& a, const Pose& b, double height) const {
    const double ex = b.x - a.x, ey = b.y - a.y, passes = side(a.x, a.y, b.x, b.y, x, y);
    const double length = std::hypot(ex, ey);
    if (length <= 0 || radius <= 0) return 0;
    const double along = ((x - a.x) * ex + (y - a.y) * ey) / length, aside = passes / length;
    if (std::abs(aside) >= radius) return 0;
    const double half = std::sqrt(radius * radius - aside * aside);
    const double from = std::max(along - half, 0.0), to = std::min(along + half, length);
    if (to <= from) return 0;
    const double z = a.z + (from + to) / (2 * length) * (b.z - a.z);
    return z >= 0 && z < height ? to - from : 0;
  }
};

// A rectangle about (x, y), its length along `heading`.
struct Rectangle {
  double x, y, length, width, heading;
  double c = std::cos(heading), s = std::sin(heading);

  bool holds(const Pose& p) const {
    const double east = p.x - x, north = p.y - y;
    return std::abs(c * east + s * north) <= length / 2 && std::abs(c * north - s * east) <= width / 2;
  }

  // Length of the link's path from a to b inside, in plan, in m.
  double way(const Pose& a, const Pose& b) const {
    const double ex = b.x - a.x, ey = b.y - a.y;
    double from = 0, to = 1;
    const auto cut = [&](double at, double by, double half) {
      if (by == 0) return;  // parallel: the other cut decides, as one end is inside
      const double one = (-half - at) / by, other = (half - at) / by;
      from = std::max(from, std::min(one, other));
      to = std::min(to, std::max(one, other));
    };
    cut(c * (a.x - x) + s * (a.y - y), c * ex + s * ey, length / 2);
    cut(c * (a.y - y) - s * (a.x - x), c * ey - s * ex, width / 2);
    return std::max(to - from, 0.0) * std::hypot(ex, ey);
  }
};

// A strip of this width about the line from one end to the other.
inline Rectangle strip(double x0, double y0, double x1, double y1, double width) {
  return {(x0 + x1) / 2, (y0 + y1) / 2, std::hypot(x1 - x0, y1 - y0), width, std::atan2(y1 - y0, x1 - x0)};
}

}  // namespace muster
