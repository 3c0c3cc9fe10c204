#include "narrow_phase.hpp"

#include <algorithm>
#include <cmath>

#include "prism.hpp"

namespace muster::simbody {

using Eigen::Vector3d;

namespace {

constexpr double face_lead = 1e-5, edge_lead = 1e-4;  // [m] by which a later axis must be better, to avoid flicker
constexpr double parallel = 1e-3;                     // sine of an angle between edges too small to define an axis
constexpr double like_a_face = 0.999;                 // cosine above which an axis of edges counts as a face's
constexpr double nearly_a_face = 0.99;                // the same for a line between corners, next to which a face
                                                      // touches
constexpr double rounding = 1e-12;                    // [m]
constexpr int passes_to_corner = 100;
constexpr double still = 1e-7;  // [m] a displacement between corners below this is ignored

Vector3d nearest_point(const Solid& solid, const Vector3d& to) {
  Vector3d p = solid.axes.transpose() * (to - solid.centre);
  if (solid.kind == Solid::Kind::sphere) {
    const double size = p.norm();
    if (size > solid.half[0]) p *= solid.half[0] / size;
  } else if (solid.kind == Solid::Kind::box) {
    p = p.cwiseMax(-solid.half).cwiseMin(solid.half);
  } else {
    const double size = p.head<2>().norm();
    if (size > solid.half[0]) p.head<2>() *= solid.half[0] / size;
    p[2] = std::clamp(p[2], -solid.half[2], solid.half[2]);
  }
  return solid.centre + solid.axes * p;
}

// For a centre inside the solid: the direction out through the nearest face, and the distance.
double way_out(const Solid& solid, const Vector3d& from, Vector3d& normal) {
  const Vector3d p = solid.axes.transpose() * (from - solid.centre);
  Vector3d out = Vector3d::Zero();
  double least;
  if (solid.kind == Solid::Kind::box) {
    const Vector3d depth = solid.half - p.cwiseAbs();
    int face;
    least = depth.minCoeff(&face);
    out[face] = std::copysign(1.0, p[face]);
  } else {
    const bool ball = solid.kind == Solid::Kind::sphere;
    const double size = ball ? p.norm() : p.head<2>().norm();
    out = size > 0 ? Vector3d(p / size) : Vector3d(Vector3d::UnitX());
    least = solid.half[0] - size;
    if (!ball) {
      out[2] = 0;
      if (solid.half[2] - std::abs(p[2]) < least) {
        least = solid.half[2] - std::abs(p[2]);
        out = std::copysign(1.0, p[2]) * Vector3d::UnitZ();
      }
    }
  }
  normal = solid.axes * out;
  return least;
}

Touch touch_sphere(const Solid& sphere, const Solid& other, double margin) {
  Touch result;
  const double radius = sphere.half[0];
  Vector3d way = sphere.centre - nearest_point(other, sphere.centre);
  double distance = way.norm();
  if (distance - radius > margin) return result;
  if (distance > 1e-9) {
    result.normal = way / distance;
  } else {
    distance = -way_out(other, sphere.centre, result.normal);
  }
  const double gap = distance - radius;
  result.add({sphere.centre - (radius + 0.5 * gap) * result.normal, gap, 0});
  return result;
}

struct Axis {
  double apart = -1e9;     // [m] negative: depth of overlap
  bool of_first = true;    // which solid's face it is
  int face = 0;            // number of that solid's face
  int edge[2] = {-1, -1};  // of both, if no face's axis is as good
  Vector3d normal;         // from the first to the second
};

// Two convex solids with their prisms.
struct Pair {
  const Solid &solid_a, &solid_b;
  const Prism &a, &b;
  double at_most;  // distance of two of their points
};

// Distance of the corner nearest to a face of the other solid from that solid.
double nearest_corner(const Pair& of, const Axis& face) {
  const Vector3d corner = face.of_first ? of.b.farthest(-face.normal) : of.a.farthest(face.normal);
  return (nearest_point(face.of_first ? of.solid_a : of.solid_b, corner) - corner).norm();
}

// Separating axis with the largest distance; false if one exceeds the margin.
bool separate(const Pair& of, double margin, Axis& best) {
  const Prism &a = of.a, &b = of.b;
  const Vector3d d = b.centre - a.centre;
  const auto apart = [&](const Vector3d& n) { return std::abs(d.dot(n)) - a.half_width(n) - b.half_width(n); };
  for (const Prism* one : {&a, &b}) {
    for (int f = 0; f < one->faces(); ++f) {
      const Vector3d n = one->normal(f);
      const double s = apart(n);
      if (s > margin) return false;
      if (s > best.apart + face_lead) best = {s, one == &a, f, {-1, -1}, n};
    }
  }
  if (best.normal.dot(d) < 0) best.normal = -best.normal;
  Axis edges = best;
  edges.apart += edge_lead;
  // No axis separates by more than the distance of two points: the search can nearly always stop here.
  const double enough = std::min(edges.apart, margin) - rounding;
  if (of.at_most <= enough || nearest_corner(of, best) <= enough) return true;
  for (int i = 0; i < a.edges(); ++i) {
    for (int j = 0; j < b.edges(); ++j) {
      Vector3d n = a.edge(i).cross(b.edge(j));
      const double sine = n.norm();
      if (sine < parallel) continue;
      n /= sine;
      const double s = apart(n);
      if (s > margin) return false;
      if (s > edges.apart) edges = {s, true, 0, {i, j}, n};
    }
  }
  if (edges.edge[0] >= 0) {
    const bool needless =
        std::abs(edges.normal.dot(best.normal)) > like_a_face;  // the many points of a face carry better
    if (!needless) best = edges;
    best.apart = edges.apart;
  }
  if (best.normal.dot(d) < 0) best.normal = -best.normal;
  return true;
}

double least_gap(const Touch& t, double margin) {
  double least = margin;
  for (int k = 0; k < t.count; ++k) least = std::min(least, t.points[k].gap);
  return least;
}

Touch touch_edges(const Prism& a, const Prism& b, const Axis& axis) {
  const int i = axis.edge[0], j = axis.edge[1];
  const Vector3d p = a.farthest(axis.normal, i), q = b.farthest(-axis.normal, j);
  const Vector3d r = q - p, &e = a.edge(i), &f = b.edge(j);
  const double cosine = e.dot(f), along_e = r.dot(e), along_f = r.dot(f), square = 1 - cosine * cosine;
  const double s = (along_e - cosine * along_f) / square, t = (cosine * along_e - along_f) / square;
  const bool beside = std::abs(s) > a.half[i] || std::abs(t) > b.half[j];
  const Vector3d on_a = p + s * e, on_b = q + t * f;
  Touch result;
  result.normal = -axis.normal;
  if (axis.apart <= 0 || !beside) result.add({0.5 * (on_a + on_b), axis.apart, 10400 + 16 * i + j});
  return result;
}

// Clips the polygon to the face's sides.
void clip(Polygon& polygon, const Polygon& face, const Vector3d& n) {
  const auto at = [](const Polygon& p, int k) { return p.corner[k == p.count ? 0 : k]; };
  Polygon room_for_rest;
  Polygon *now = &polygon, *rest = &room_for_rest;
  const double turn = (at(face, 1) - at(face, 0)).cross(at(face, 2) - at(face, 1)).dot(n) < 0 ? -1 : 1;
  for (int side = 0; side < face.count && now->count > 0; ++side) {
    const Vector3d outward = turn * (at(face, side + 1) - at(face, side)).cross(n);
    const double limit = outward.dot(at(face, side));
    rest->count = 0;
    for (int k = 0; k < now->count; ++k) {
      const Vector3d p = at(*now, k), q = at(*now, k + 1);
      const double over_p = outward.dot(p) - limit, over_q = outward.dot(q) - limit;
      const int mark = now->mark[k];
      if (over_p <= 0) rest->add(p, mark);
      if ((over_p <= 0) != (over_q <= 0))
        rest->add(p + (over_p / (over_p - over_q)) * (q - p), 32 * (side + 1) + 2 * (mark % 16) + (over_p <= 0));
    }
    std::swap(now, rest);
  }
  if (now != &polygon) polygon = *now;
}

// Reduces many points to those that carry: the outermost along four directions, diagonal to u, and the deepest.
void keep_few(const std::array<TouchPoint, Polygon::room>& points, int count, const Vector3d& u, Touch& result) {
  if (count < Touch::most_points) {
    for (int k = 0; k < count; ++k) result.add(points[k]);
    return;
  }
  const Vector3d v = result.normal.cross(u);
  std::array<bool, Polygon::room> kept{};
  const auto keep_most = [&](auto measure) {
    int best = 0;
    for (int k = 1; k < count; ++k) {
      if (measure(points[k]) > measure(points[best]) + 1e-9) best = k;
    }
    kept[best] = true;
  };
  for (const Vector3d& way : {Vector3d(u + v), Vector3d(u - v), Vector3d(-u + v), Vector3d(-u - v)})
    keep_most([&](const TouchPoint& p) { return way.dot(p.place); });
  keep_most([](const TouchPoint& p) { return -p.gap; });
  for (int k = 0; k < count; ++k) {
    if (kept[k]) result.add(points[k]);
  }
}

Touch touch_faces(const Prism& a, const Prism& b, const Axis& axis, double margin) {
  const Prism &of = axis.of_first ? a : b, &other = axis.of_first ? b : a;
  const Vector3d n = axis.of_first ? axis.normal : -axis.normal;  // outward of the face
  const Polygon face = of.face(axis.face, n);
  const double level = n.dot(face.corner[0]);
  Polygon inside = other.face(other.face_towards(n), -n);
  clip(inside, face, n);
  Touch result;
  result.normal = -axis.normal;
  std::array<TouchPoint, Polygon::room> points;
  int count = 0;
  for (int k = 0; k < inside.count; ++k) {
    const Vector3d& p = inside.corner[k];
    const double gap = n.dot(p) - level;
    const int mark = inside.mark[k] + 576 * (axis.face + (axis.of_first ? 0 : 9));
    if (gap < margin) points[count++] = {p - 0.5 * gap * n, gap, mark};
  }
  keep_few(points, count, of.edge(axis.face < of.sides ? axis.face : 0), result);
  return result;
}

// Corners and edges that no face covers: the nearest points, by alternating projections between the solids.
Touch touch_corners(const Solid& a, const Solid& b, double margin) {
  Vector3d q = b.centre, p = q;
  for (int pass = 0; pass < passes_to_corner; ++pass) {
    const Vector3d before = q;
    p = nearest_point(a, q);
    q = nearest_point(b, p);
    if ((q - before).squaredNorm() < still * still) break;
  }
  Touch result;
  const double gap = (p - q).norm();
  if (gap > margin) return result;
  result.normal = (p - q).normalized();
  result.add({0.5 * (p + q), gap, 16000, true});
  return result;
}

// The deepest corner along the axis, covered by a face or not.
TouchPoint deepest(const Prism& a, const Prism& b, const Axis& axis) {
  const Vector3d corner = axis.of_first ? b.farthest(-axis.normal) : a.farthest(axis.normal);
  return {corner + (axis.of_first ? -0.5 : 0.5) * axis.apart * axis.normal, axis.apart, 16001};
}

// True if the plane through the place of `a` nearest to `on_b`, normal to the line between them, separates the solids:
// all of `a` is on its far side. It finds nearly all separate pairs, at a fraction of the cost of all axes.
bool are_apart(const Solid& b, const Vector3d& on_a, const Vector3d& on_b, double margin) {
  const Vector3d way = on_a - on_b;
  const double distance = way.norm();
  if (distance <= margin) return false;
  const Vector3d n = way / distance, along = b.axes.transpose() * n;
  const double half_width = b.kind == Solid::Kind::box
                                ? b.half.dot(along.cwiseAbs())
                                : b.half[0] * along.head<2>().norm() + b.half[2] * std::abs(along[2]);
  return n.dot(on_a - b.centre) - half_width > margin;
}

}  // namespace

double Solid::reach() const {
  if (kind == Kind::sphere) return half[0];
  return kind == Kind::box ? half.norm() : std::sqrt(half[0] * half[0] + half[2] * half[2]);
}

Touch touch(const Solid& a, const Solid& b, double margin) {
  if (a.kind == Solid::Kind::sphere) return touch_sphere(a, b, margin);
  if (b.kind == Solid::Kind::sphere) {
    Touch result = touch_sphere(b, a, margin);
    result.normal = -result.normal;
    return result;
  }
  const Vector3d on_b = nearest_point(b, a.centre), on_a = nearest_point(a, on_b);
  if (are_apart(b, on_a, on_b, margin)) return {};
  const Prism first(a, on_b), second(b, nearest_point(a, b.centre));
  Axis axis;
  if (!separate({a, b, first, second, (on_a - on_b).norm()}, margin, axis)) return {};
  Touch result = axis.edge[0] >= 0 ? touch_edges(first, second, axis) : touch_faces(first, second, axis, margin);
  if (least_gap(result, margin) <= axis.apart + face_lead) return result;
  // No face covers the nearest features.
  if (axis.apart > 0) {
    Touch corners = touch_corners(a, b, margin);
    if (corners.count == 0) return result;
    const Vector3d &n = corners.normal, d = a.centre - b.centre;
    const bool is_alone = result.count == 0 || n.dot(result.normal) < nearly_a_face;
    if (is_alone && n.dot(d) - first.half_width(n) - second.half_width(n) > axis.apart) return corners;
    result.add({corners.points[0].place, axis.apart, 16000});
    return result;
  }
  result.add(deepest(first, second, axis));
  return result;
}

Touch touch_ground(const Solid& solid, double margin) {
  Touch result;
  result.normal = Vector3d::UnitZ();
  if (solid.kind == Solid::Kind::sphere) {
    const double gap = solid.centre.z() - solid.half[0];
    if (gap < margin) result.add({{solid.centre.x(), solid.centre.y(), 0.5 * gap}, gap, 0});
    return result;
  }
  const Prism prism(solid, solid.centre - Vector3d::UnitZ());
  if (prism.centre.z() - prism.half_width(result.normal) >= margin) return result;
  std::array<TouchPoint, Polygon::room> points;
  int count = 0;
  for (const double end : {1.0, -1.0}) {
    const Polygon face = prism.face(prism.sides, end * prism.edge(prism.sides));
    for (int k = 0; k < face.count; ++k) {
      const Vector3d& p = face.corner[k];
      if (p.z() < margin) points[count++] = {{p.x(), p.y(), 0.5 * p.z()}, p.z(), k + (end > 0 ? 0 : 16)};
    }
  }
  keep_few(points, count, Vector3d::UnitX(), result);
  return result;
}

}  // namespace muster::simbody
