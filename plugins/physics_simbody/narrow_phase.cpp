#include "narrow_phase.hpp"

#include <algorithm>
#include <cmath>

namespace muster::simbody {

using Eigen::Vector3d;

namespace {

constexpr double face_lead = 1e-5, edge_lead = 1e-4;  // [m] by which a later axis must be better, so that none flickers
constexpr double parallel = 1e-3;                     // sine of an angle between edges that name no axis
constexpr double like_a_face = 0.999;                 // cosine above which an edges' axis is a face's
constexpr double nearly_a_face = 0.99;                // the same, of a way between corners beside which a face touches
constexpr int passes_to_corner = 100;
constexpr double still = 1e-7;  // [m] less than this a pass between corners does not move them

constexpr int most_sides = 8;  // pairs of opposite sides of a cylinder's prism
constexpr int most_corners = 2 * most_sides;

constexpr int room = 2 * most_corners;  // a side that clips a convex polygon adds one corner at most

// A polygon of a face, in order around its normal; a mark with each corner.
struct Polygon {
  int count = 0;
  std::array<Vector3d, room> corner;
  std::array<int, room> mark;

  void add(const Vector3d& p, int m) {
    if (count == room) return;
    corner[count] = p;
    mark[count++] = m;
  }
};

// A box or a cylinder as the sum of segments: its sides' half edges, in order of angle, and its axis at last. All of
// a prism follows from them: its width along any direction, its faces (each lies along one side and the axis, or across
// the axis), its edges.
struct Prism {
  // The middle of one side of a cylinder's prism lies towards `place`, on the circle itself.
  Prism(const Solid& solid, const Vector3d& place) : centre(solid.centre) {
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
    const Vector3d axis = solid.axes.col(2);
    Vector3d outward = place - centre;
    outward -= axis.dot(outward) * axis;
    const double distance = outward.norm();
    outward = distance > 1e-6 ? Vector3d(outward / distance) : Vector3d(solid.axes.col(0));
    const Vector3d along = axis.cross(outward);
    for (int i = 0; i < sides; ++i) set(i, circle[i][0] * along - circle[i][1] * outward, half_side * solid.half[0]);
    set(sides, axis, solid.half[2]);
  }

  void set(int i, const Vector3d& direction, double length) {
    way[i] = direction;
    half[i] = length;
  }
  const Vector3d& edge(int i) const { return way[i]; }
  Vector3d half_edge(int i) const { return half[i] * edge(i); }
  int edges() const { return sides + 1; }
  int faces() const { return sides + 1; }
  // Of one of a pair of opposite faces: those along a side, at last those across the axis.
  Vector3d normal(int face) const { return face < sides ? edge(face).cross(edge(sides)) : edge(sides); }

  double half_width(const Vector3d& n) const {
    double sum = 0;
    for (int i = 0; i < edges(); ++i) sum += half[i] * std::abs(n.dot(edge(i)));
    return sum;
  }
  // The farthest place along n; where edges lie across n (all of `but`), their middle.
  Vector3d farthest(const Vector3d& n, int but = -1, int but_too = -1) const {
    Vector3d p = centre;
    for (int i = 0; i < edges(); ++i) {
      if (i != but && i != but_too) p += std::copysign(1.0, n.dot(edge(i))) * half_edge(i);
    }
    return p;
  }

  Polygon face(int f, const Vector3d& n) const {
    Polygon polygon;
    if (f < sides) {
      const Vector3d middle = farthest(n, f, sides), u = half_edge(f), v = half_edge(sides);
      polygon.add(middle + u + v, 0);
      polygon.add(middle - u + v, 1);
      polygon.add(middle - u - v, 2);
      polygon.add(middle + u - v, 3);
    } else {
      Vector3d p = centre + std::copysign(1.0, n.dot(edge(sides))) * half_edge(sides);
      for (int i = 0; i < sides; ++i) p += half_edge(i);
      for (int k = 0; k < 2 * sides; ++k) {
        polygon.add(p, k);
        p += (k < sides ? -2 : 2) * half_edge(k % sides);
      }
    }
    return polygon;
  }

  int face_towards(const Vector3d& n) const {
    int best = 0;
    double most = -1;
    for (int f = 0; f < faces(); ++f) {
      const double along = std::abs(n.dot(normal(f)));
      if (along > most) most = along, best = f;
    }
    return best;
  }

  int sides;
  Vector3d centre;
  std::array<Vector3d, most_sides + 1> way;  // unit: kept apart from lengths, which may be zero
  std::array<double, most_sides + 1> half;
};

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

// For a centre inside the solid: the way out through the nearest face, and how far that is.
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
  double apart = -1e9;     // [m] negative: how far they overlap
  bool of_first = true;    // whose face it is
  int face = 0;            // of that solid
  int edge[2] = {-1, -1};  // of both, where no face's axis is as good
  Vector3d normal;         // from the first to the second
};

// The axis that separates best; false where one separates by more than the margin.
bool separate(const Prism& a, const Prism& b, double margin, Axis& best) {
  const Vector3d d = b.centre - a.centre;
  const auto apart = [&](const Vector3d& n) { return std::abs(d.dot(n)) - a.half_width(n) - b.half_width(n); };
  for (const Prism* of : {&a, &b}) {
    for (int f = 0; f < of->faces(); ++f) {
      const Vector3d n = of->normal(f);
      const double s = apart(n);
      if (s > margin) return false;
      if (s > best.apart + face_lead) best = {s, of == &a, f, {-1, -1}, n};
    }
  }
  Axis edges = best;
  edges.apart += edge_lead;
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
    const bool needless = std::abs(edges.normal.dot(best.normal)) > like_a_face;  // a face's many points carry better
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

// Leaves of the polygon what lies inside the face's sides.
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

// Of many points those that carry: the outermost along four ways, diagonal to u, and the deepest.
void keep_few(const std::array<TouchPoint, room>& points, int count, const Vector3d& u, Touch& result) {
  if (count < Touch::most_points) {
    for (int k = 0; k < count; ++k) result.add(points[k]);
    return;
  }
  const Vector3d v = result.normal.cross(u);
  std::array<bool, room> kept{};
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
  std::array<TouchPoint, room> points;
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

// Corners and edges before which no face lies: the nearest points, by projecting from one solid to the other.
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

// The corner that lies deepest along the axis, whether a face lies over it or not.
TouchPoint deepest(const Prism& a, const Prism& b, const Axis& axis) {
  const Vector3d corner = axis.of_first ? b.farthest(-axis.normal) : a.farthest(axis.normal);
  return {corner + (axis.of_first ? -0.5 : 0.5) * axis.apart * axis.normal, axis.apart, 16001};
}

// Whether the plane through the place of `a` nearest to `on_b`, across the way there, keeps the solids apart: all of
// `a` lies on its far side. Nearly all that are apart are found so, at a fraction of what all axes cost.
bool are_apart(const Solid& a, const Solid& b, const Vector3d& on_b, double margin) {
  const Vector3d on_a = nearest_point(a, on_b), way = on_a - on_b;
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
  const Vector3d on_b = nearest_point(b, a.centre);
  if (are_apart(a, b, on_b, margin)) return {};
  const Prism first(a, on_b), second(b, nearest_point(a, b.centre));
  Axis axis;
  if (!separate(first, second, margin, axis)) return {};
  Touch result = axis.edge[0] >= 0 ? touch_edges(first, second, axis) : touch_faces(first, second, axis, margin);
  if (least_gap(result, margin) <= axis.apart + face_lead) return result;
  // What is nearest lies over no face.
  if (axis.apart > 0) {
    const Touch corners = touch_corners(a, b, margin);
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
  std::array<TouchPoint, room> points;
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
