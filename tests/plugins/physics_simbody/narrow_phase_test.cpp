// Touching solids, against closed forms and against their support functions.
#include "narrow_phase.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace muster::simbody {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Kind = Solid::Kind;

constexpr double far = 1e9;

Solid box(const Vector3d& centre, const Vector3d& half, double yaw = 0) {
  return {Kind::box, centre, Eigen::AngleAxisd(yaw, Vector3d::UnitZ()).toRotationMatrix(), half};
}
Solid sphere(const Vector3d& centre, double radius) {
  return {Kind::sphere, centre, Matrix3d::Identity(), Vector3d::Constant(radius)};
}
Solid cylinder(const Vector3d& centre, double radius, double length) {
  return {Kind::cylinder, centre, Matrix3d::Identity(), {radius, radius, length / 2}};
}

double least_gap(const Touch& t) {
  double least = far;
  for (int k = 0; k < t.count; ++k) least = std::min(least, t.points[k].gap);
  return least;
}

// Extent of the solid along n from its centre: the definition, without prisms.
double support(const Solid& s, const Vector3d& n) {
  const Vector3d p = s.axes.transpose() * n;
  if (s.kind == Kind::sphere) return s.half[0] * n.norm();
  if (s.kind == Kind::box) return s.half.dot(p.cwiseAbs());
  return s.half[0] * p.head<2>().norm() + s.half[2] * std::abs(p[2]);
}
double apart_along(const Solid& a, const Solid& b, const Vector3d& n) {
  return n.dot(a.centre - b.centre) - support(a, n) - support(b, n);
}

// Tolerance for a cylinder's prism.
double roughness(const Solid& a, const Solid& b) {
  double sum = 0;
  for (const Solid* s : {&a, &b}) sum += s->kind == Kind::cylinder ? 0.02 * s->half[0] : 0;
  return sum;
}

class Draws {
 public:
  explicit Draws(unsigned seed) : random_(seed) {}
  double operator()(double low, double high) {
    return low + (high - low) * (static_cast<double>(random_()) / 4294967296.0);
  }
  Vector3d vector(double size) { return {(*this)(-size, size), (*this)(-size, size), (*this)(-size, size)}; }
  Matrix3d rotation() {
    Eigen::Quaterniond q(normal_(random_), normal_(random_), normal_(random_), normal_(random_));
    return q.normalized().toRotationMatrix();
  }
  Vector3d way() { return rotation().col(0); }
  Solid solid(Kind kind) {
    Solid s{kind, vector(0.3), rotation(), {(*this)(0.05, 0.3), (*this)(0.05, 0.3), (*this)(0.05, 0.3)}};
    if (kind == Kind::sphere) s.half = Vector3d::Constant(s.half[0]);
    if (kind == Kind::cylinder) s.half[1] = s.half[0];
    return s;
  }

 private:
  std::mt19937 random_;
  std::normal_distribution<double> normal_;
};

const std::vector<std::pair<Kind, Kind>> pairs = {{Kind::sphere, Kind::sphere},   {Kind::sphere, Kind::box},
                                                  {Kind::sphere, Kind::cylinder}, {Kind::box, Kind::box},
                                                  {Kind::box, Kind::cylinder},    {Kind::cylinder, Kind::cylinder}};

TEST(NarrowPhase, FaceOnFaceGivesItsCorners) {
  const Touch t = touch(box({0, 0, 0.99}, {0.2, 0.3, 0.5}), box({0.1, 0, 0}, {0.2, 0.1, 0.5}), 0.01);
  ASSERT_EQ(t.count, 4);
  EXPECT_LT((t.normal - Vector3d::UnitZ()).norm(), 1e-12);
  double low_x = far, high_x = -far, low_y = far, high_y = -far;
  for (int k = 0; k < 4; ++k) {
    const TouchPoint& p = t.points[k];
    EXPECT_NEAR(p.gap, -0.01, 1e-12);
    EXPECT_NEAR(p.place.z(), 0.495, 1e-12);
    low_x = std::min(low_x, p.place.x()), high_x = std::max(high_x, p.place.x());
    low_y = std::min(low_y, p.place.y()), high_y = std::max(high_y, p.place.y());
  }
  EXPECT_NEAR(low_x, -0.1, 1e-12);
  EXPECT_NEAR(high_x, 0.2, 1e-12);
  EXPECT_NEAR(low_y, -0.1, 1e-12);
  EXPECT_NEAR(high_y, 0.1, 1e-12);
}

TEST(NarrowPhase, CornerBeforeFaceGivesThatCorner) {
  const double reach = 0.1 * std::sqrt(2.0);
  const Touch t =
      touch(box({0.5 + reach + 0.002, 0.2, 0}, {0.1, 0.1, 0.1}, M_PI / 4), box({0, 0, 0}, {0.5, 0.5, 0.5}), 0.01);
  ASSERT_EQ(t.count, 2);  // both ends of its upright edge
  for (int k = 0; k < 2; ++k) {
    EXPECT_NEAR(t.points[k].gap, 0.002, 1e-12);
    EXPECT_NEAR(t.points[k].place.y(), 0.2, 1e-12);
  }
  EXPECT_LT((t.normal - Vector3d::UnitX()).norm(), 1e-12);
}

// Two long edges across each other: the gap is that of the lines.
TEST(NarrowPhase, CrossedEdgesTouchInOnePoint) {
  Solid a = box({0, 0, 0}, {1, 0.1, 0.1}), b = box({0.05, 0.02, 0}, {0.1, 1, 0.1});
  a.axes = Eigen::AngleAxisd(M_PI / 4, Vector3d::UnitX()).toRotationMatrix();
  b.axes = Eigen::AngleAxisd(M_PI / 4, Vector3d::UnitY()).toRotationMatrix();
  b.centre.z() = -0.2 * std::sqrt(2.0) - 0.003;
  const Touch t = touch(a, b, 0.01);
  ASSERT_EQ(t.count, 1);
  EXPECT_NEAR(t.points[0].gap, 0.003, 1e-12);
  EXPECT_NEAR(t.points[0].place.x(), 0.05, 1e-12);
  EXPECT_NEAR(t.points[0].place.y(), 0, 1e-12);
  EXPECT_LT((t.normal - Vector3d::UnitZ()).norm(), 1e-12);
}

// Tilted by 6 mrad against a tall wall, like a nodding robot: a shortcut in plan would find 3 mm of overlap.
TEST(NarrowPhase, SlightTiltAgainstATallWallIsNoOverlap) {
  Solid robot = box({-0.101, 0, 0.1}, {0.1, 0.07, 0.06});
  robot.axes = Eigen::AngleAxisd(0.006, Vector3d::UnitY()).toRotationMatrix();
  const Touch t = touch(robot, box({0.05, 0, 0.5}, {0.05, 2, 0.5}), 0.01);
  ASSERT_GT(t.count, 0);
  EXPECT_NEAR(least_gap(t), 0.101 - 0.1 * std::cos(0.006) - 0.06 * std::sin(0.006), 1e-9);
}

TEST(NarrowPhase, CornerPassingCornerSeesTheirDistance) {
  const Touch t = touch(box({0.203, 0.204, 0}, {0.1, 0.1, 0.1}), box({0, 0, 0}, {0.1, 0.1, 0.1}), 0.01);
  ASSERT_EQ(t.count, 1);
  EXPECT_NEAR(t.points[0].gap, 0.005, 1e-9);
  EXPECT_LT((t.normal - Vector3d(0.6, 0.8, 0)).norm(), 1e-6);
}

// A box over a corner of another, tilted so little that its lowest corner, beside the other, is lower by less than the
// threshold for an axis of edges: it still rests on all of the overlap, not on the nearest place.
TEST(NarrowPhase, FacesKeepTheirPointsBesideANearerCorner) {
  constexpr double tilt = 5e-4;
  const Vector3d about = Vector3d(1, 1, 0).normalized();
  Solid a = box({0.15, 0.15, 0.2}, {0.1, 0.1, 0.1});
  a.axes = Eigen::AngleAxisd(tilt, about).toRotationMatrix();
  a.centre.z() += 0.001 + 0.1 * std::sqrt(2.0) * std::sin(tilt);  // its lowest corner is 1 mm above the other
  const Touch t = touch(a, box({0, 0, 0}, {0.1, 0.1, 0.1}), 0.01);
  ASSERT_GE(t.count, 4);
  EXPECT_NEAR(least_gap(t), 0.001, 1e-4);
  Eigen::AlignedBox3d spread;
  for (int k = 0; k < t.count; ++k) {
    EXPECT_FALSE(t.points[k].of_corners);
    spread.extend(t.points[k].place);
  }
  for (int way : {0, 1}) {
    EXPECT_NEAR(spread.min()[way], 0.05, 2e-4);
    EXPECT_NEAR(spread.max()[way], 0.1, 2e-4);
  }
}

TEST(NarrowPhase, SphereIsExact) {
  const Solid ball = sphere({0.3, 0.4, 0}, 0.45);
  Touch t = touch(ball, sphere({0, 0, 0}, 0.1), 0.01);  // centres 0.5 apart
  ASSERT_EQ(t.count, 1);
  EXPECT_NEAR(t.points[0].gap, -0.05, 1e-12);
  EXPECT_LT((t.normal - Vector3d(0.6, 0.8, 0)).norm(), 1e-12);
  t = touch(sphere({0.13, 0.14, 0.3}, 0.045), box({0, 0, 0}, {0.1, 0.1, 0.5}), 0.01);  // an edge at (0.1, 0.1)
  ASSERT_EQ(t.count, 1);
  EXPECT_NEAR(t.points[0].gap, 0.005, 1e-12);
  t = touch(sphere({0.13, 0, 0.24}, 0.045), cylinder({0, 0, 0}, 0.1, 0.4), 0.01);  // its rim
  ASSERT_EQ(t.count, 1);
  EXPECT_NEAR(t.points[0].gap, 0.005, 1e-12);
  t = touch(sphere({0.01, 0.09, 0.02}, 0.02), box({0, 0, 0}, {0.1, 0.1, 0.5}), 0.01);  // its centre inside
  ASSERT_EQ(t.count, 1);
  EXPECT_NEAR(t.points[0].gap, -0.03, 1e-12);
  EXPECT_LT((t.normal - Vector3d::UnitY()).norm(), 1e-12);
}

TEST(NarrowPhase, UprightCylindersTouchExactlySideOnSide) {
  for (double angle = 0; angle < 6.3; angle += 0.1) {
    const Vector3d way(std::cos(angle), std::sin(angle), 0);
    const Touch t = touch(cylinder(0.3 * way, 0.1, 1), cylinder({0, 0, 0}, 0.2, 1), 0.01);
    ASSERT_GT(t.count, 0) << angle;
    EXPECT_NEAR(least_gap(t), 0, 1e-9) << angle;
    EXPECT_GT(t.normal.dot(way), 1 - 1e-9) << angle;
  }
}

TEST(NarrowPhase, CylinderOnItsEndStandsOnSpreadPoints) {
  const Touch t = touch(cylinder({0, 0, 0.6}, 0.1, 0.2), box({0, 0, 0}, {1, 1, 0.5}), 0.01);
  ASSERT_GE(t.count, 4);
  Vector3d sum = Vector3d::Zero();
  for (int k = 0; k < t.count; ++k) {
    EXPECT_NEAR(t.points[k].gap, 0, 1e-12);
    EXPECT_NEAR(t.points[k].place.head<2>().norm(), 0.1, 0.0021);
    sum += t.points[k].place;
  }
  EXPECT_LT(sum.head<2>().norm() / t.count, 0.03);
}

TEST(NarrowPhase, GroundCarriesLowCorners) {
  const Touch flat = touch_ground(box({1, 2, 0.099}, {0.2, 0.3, 0.1}), 0.01);
  ASSERT_EQ(flat.count, 4);
  EXPECT_NEAR(least_gap(flat), -0.001, 1e-12);
  EXPECT_EQ(touch_ground(box({1, 2, 0.12}, {0.2, 0.3, 0.1}), 0.01).count, 0);
  EXPECT_EQ(touch_ground(sphere({0, 0, 0.04}, 0.05), 0.01).count, 1);
}

// The distance by brute force: alternating projections to the nearest point until they converge.
Vector3d nearest(const Solid& s, const Vector3d& to) {
  Vector3d p = s.axes.transpose() * (to - s.centre);
  const double size = s.kind == Kind::sphere ? p.norm() : p.head<2>().norm();
  if (s.kind == Kind::sphere && size > s.half[0]) p *= s.half[0] / size;
  if (s.kind == Kind::cylinder && size > s.half[0]) p.head<2>() *= s.half[0] / size;
  if (s.kind == Kind::box) p = p.cwiseMin(s.half).cwiseMax(-s.half);
  if (s.kind == Kind::cylinder) p[2] = std::max(-s.half[2], std::min(s.half[2], p[2]));
  return s.centre + s.axes * p;
}
double distance(const Solid& a, const Solid& b) {
  Vector3d q = b.centre, p = q;
  for (int k = 0; k < 3000; ++k) p = nearest(a, q), q = nearest(b, p);
  return (p - q).norm();
}

// Two solids whose extreme places along a random direction are `apart`.
std::pair<Solid, Solid> near_pair(Draws& draw, const std::pair<Kind, Kind>& kinds, double apart) {
  const Solid a = draw.solid(kinds.first);
  Solid b = draw.solid(kinds.second);
  const Vector3d way = draw.way();
  b.centre += nearest(a, a.centre + 10 * way) + apart * way - nearest(b, b.centre - 10 * way);
  return {a, b};
}

// The largest separation of two solids along any direction, searched from `way` on: negative for the depth of overlap.
double most_apart(Draws& draw, const Solid& a, const Solid& b, Vector3d way) {
  double best = apart_along(a, b, way), spread = 0.1;
  for (int k = 0; k < 400; ++k, spread *= 0.98) {
    const Vector3d other = (way + draw.vector(spread)).normalized();
    const double apart = apart_along(a, b, other);
    if (apart > best) best = apart, way = other;
  }
  return best;
}

TEST(NarrowPhase, DepthIsThatOfTheBestWayOut) {
  Draws draw(5);
  for (const auto& kinds : pairs) {
    int overlapping = 0;
    for (int trial = 0; trial < 500; ++trial) {
      const auto [a, b] = near_pair(draw, kinds, draw(-0.02, 0));
      const double rough = roughness(a, b) + 2e-4;
      const Touch t = touch(a, b, 0.03);
      if (distance(a, b) > 1e-6) continue;
      ++overlapping;
      ASSERT_GT(t.count, 0);
      ASSERT_NEAR(t.normal.norm(), 1, 1e-9);
      EXPECT_NEAR(least_gap(t), most_apart(draw, a, b, t.normal), rough);
      for (int k = 0; k < 300; ++k) EXPECT_LE(apart_along(a, b, draw.way()), least_gap(t) + rough);
    }
    EXPECT_GT(overlapping, 100);
  }
}

TEST(NarrowPhase, GapIsNoLongerThanTheDistanceAndItsWaySeparates) {
  constexpr double margin = 0.02;
  Draws draw(9);
  for (const auto& kinds : pairs) {
    int separate = 0, far_off = 0;
    for (int trial = 0; trial < 500; ++trial) {
      const auto [a, b] = near_pair(draw, kinds, draw(0.001, 0.04));
      const double rough = roughness(a, b) + 1e-6, between = distance(a, b);
      const Touch t = touch(a, b, margin);
      if (t.count == 0) {
        ++far_off;
        EXPECT_GE(between, margin - rough - 1e-3);
        continue;
      }
      ++separate;
      EXPECT_GT(least_gap(t), -rough);
      EXPECT_GE(apart_along(a, b, t.normal), -rough);
      if (t.points[0].mark != 16000) {
        EXPECT_LE(least_gap(t), between + rough);
      }
      for (int k = 0; k < t.count; ++k) {  // between the solids, half a gap from each
        const TouchPoint& p = t.points[k];
        for (const Solid* s : {&a, &b}) EXPECT_LE((p.place - nearest(*s, p.place)).norm(), 0.5 * margin + rough);
      }
    }
    EXPECT_GT(separate, 50);
    EXPECT_GT(far_off, 50);
  }
}

TEST(NarrowPhase, ExchangedSolidsTouchAlike) {
  Draws draw(6);
  for (const auto& [kind_a, kind_b] : pairs) {
    for (int trial = 0; trial < 300; ++trial) {
      const auto [a, b] = near_pair(draw, {kind_a, kind_b}, draw(-0.02, 0.02));
      const Touch t = touch(a, b, 0.02), back = touch(b, a, 0.02);
      ASSERT_EQ(t.count > 0, back.count > 0);
      if (t.count == 0) continue;
      EXPECT_NEAR(least_gap(t), least_gap(back), 3e-4 + roughness(a, b));
      // Of two equal axes either may be taken; both must give the same depth.
      EXPECT_NEAR(apart_along(a, b, t.normal), apart_along(b, a, back.normal), 3e-4 + roughness(a, b));
    }
  }
}

TEST(NarrowPhase, RigidMotionMovesTheTouchAlong) {
  Draws draw(7);
  int moved_points = 0;
  for (const auto& [kind_a, kind_b] : pairs) {
    for (int trial = 0; trial < 300; ++trial) {
      const auto [a, b] = near_pair(draw, {kind_a, kind_b}, draw(-0.02, 0.02));
      const Matrix3d turn = draw.rotation();
      const Vector3d shift = draw.vector(5);
      const auto moved = [&](const Solid& s) { return Solid{s.kind, turn * s.centre + shift, turn * s.axes, s.half}; };
      const Touch t = touch(a, b, 0.02), there = touch(moved(a), moved(b), 0.02);
      ASSERT_EQ(t.count, there.count);
      if (t.count == 0) continue;
      EXPECT_LT((turn * t.normal - there.normal).norm(), 1e-9);
      EXPECT_NEAR(least_gap(t), least_gap(there), 1e-9);
      for (int k = 0; k < t.count; ++k, ++moved_points) {
        const auto &p = t.points[k], &q = there.points[k];
        EXPECT_LT((turn * p.place + shift - q.place).norm(), 1e-9);
        EXPECT_EQ(p.mark, q.mark);
      }
    }
  }
  EXPECT_GT(moved_points, 1000);
}

TEST(NarrowPhase, MarksTellPointsApart) {
  Draws draw(8);
  for (int trial = 0; trial < 300; ++trial) {
    const Touch t = touch(draw.solid(Kind::box), draw.solid(Kind::cylinder), 0.02);
    for (int i = 0; i < t.count; ++i) {
      EXPECT_GE(t.points[i].mark, 0);
      EXPECT_LT(t.points[i].mark, 1 << 14);
      for (int j = 0; j < i; ++j) EXPECT_NE(t.points[i].mark, t.points[j].mark);
    }
  }
}

TEST(NarrowPhase, WallWithoutThicknessIsAWall) {
  const Touch t = touch(box({0, 0.0998, 0}, {0.2, 0.1, 0.1}), box({0, 0, 0}, {2, 0, 1}), 0.01);
  ASSERT_EQ(t.count, 4);
  EXPECT_NEAR(least_gap(t), -0.0002, 1e-12);
  EXPECT_LT((t.normal - Vector3d::UnitY()).norm(), 1e-12);
}

}  // namespace
}  // namespace muster::simbody
