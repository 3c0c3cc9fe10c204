// Shapes in the plan that the world's map lacks, and their intersection with a straight link.
#pragma once

#include <algorithm>
#include <cmath>
#include <muster/tables.hpp>

#include "link_term.hpp"

namespace muster {

// Twice the signed area of a triangle: positive where the point is to the left of a -> b.
inline double side(double ax, double ay, double bx, double by, double x, double y) {
  return (bx - ax) * (y - ay) - (by - ay) * (x - ax);
}

// An upright wall without thickness, from the ground up.
struct Segment {
  double x0, y0, x1, y1;
  double length = std::hypot(x1 - x0, y1 - y0);

  // Share of it that the link from a to b meets, 0 to 1: half where it passes an end, all from edge / 2 further in.
  double share(const Pose& a, const Pose& b, double height, double edge) const {
    const double sa = side(x0, y0, x1, y1, a.x, a.y), sb = side(x0, y0, x1, y1, b.x, b.y);
    if ((sa > 0) == (sb > 0)) return 0;  // on one side of its line, as if its length is 0
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

// Which of many links have a share() of a segment above 0 but for their height: `met` is 0 for all others. By the same
// arithmetic, in the order of the ends of LinkTerm::add_both_ways().
struct MeetsSegment {
  [[gnu::always_inline]] static void run(const PlanEnds& ends, std::size_t count, const Segment& wall, double edge,
                                         double* met) {
    const double x0 = wall.x0, y0 = wall.y0, ex = wall.x1 - x0, ey = wall.y1 - y0, over = std::max(edge, 1e-9);
    const double least = -over * wall.length, most = (wall.length + over) * wall.length;
    for (std::size_t i = 0; i < count; ++i) {
      const double ax = ends.ax[i], ay = ends.ay[i], bx = ends.bx[i], by = ends.by[i];
      const double turned = bx < ax ? 1.0 : bx == ax ? (by < ay ? 1.0 : 0.0) : 0.0;
      const double px = turned != 0 ? bx : ax, py = turned != 0 ? by : ay;
      const double qx = turned != 0 ? ax : bx, qy = turned != 0 ? ay : by;
      const double sp = ex * (py - y0) - ey * (px - x0), sq = ex * (qy - y0) - ey * (qx - x0);
      const double at = sp / (sp - sq), x = px + at * (qx - px), y = py + at * (qy - py);
      const double lengthwise = (x - x0) * ex + (y - y0) * ey;
      double result = (sp > 0 ? 1.0 : 0.0) != (sq > 0 ? 1.0 : 0.0) ? 1.0 : 0.0;
      result = lengthwise < least ? 0.0 : result;
      result = lengthwise > most ? 0.0 : result;
      met[i] = result;
    }
  }
};

// An upright cylinder on the ground.
struct Disk {
  double x, y, radius;

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

// Which of many links may pass through a disk, as few do: `met` is 0 for all others. The same in either direction
// except within rounding.
struct MeetsDisk {
  [[gnu::always_inline]] static void run(const PlanEnds& ends, std::size_t count, const Disk& disk, double* met) {
    const double x = disk.x, y = disk.y, within = 1.001 * disk.radius * disk.radius;
    for (std::size_t i = 0; i < count; ++i) {
      const double ex = ends.bx[i] - ends.ax[i], ey = ends.by[i] - ends.ay[i];
      const double passes = ex * (y - ends.ay[i]) - ey * (x - ends.ax[i]);
      met[i] = passes * passes <= within * (ex * ex + ey * ey) ? 1.0 : 0.0;
    }
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
