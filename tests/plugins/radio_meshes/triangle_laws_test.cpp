// Crossings of one triangle, and of closed surfaces of triangles.
#include <gtest/gtest.h>

#include "drawn.hpp"

namespace muster {
namespace {

int crossings(const std::vector<Triangle>& surface, const Vector& p, const Vector& q) {
  int result = 0;
  for (const Triangle& t : surface) result += t.is_crossed(p, q);
  return result;
}

TEST(TriangleCrossing, IsWhereTheLinkPassesThrough) {
  const Triangle t{{0, 0, 10}, {100, 0, 10}, {0, 100, 10}};
  EXPECT_TRUE(t.is_crossed({20, 20, 0}, {20, 20, 20}));
  EXPECT_TRUE(t.is_crossed({-50, -50, -10}, {90, 90, 40}));  // at 6, 6
  EXPECT_FALSE(t.is_crossed({20, 20, 0}, {20, 20, 9}));      // too short
  EXPECT_FALSE(t.is_crossed({60, 60, 0}, {60, 60, 20}));     // beside
  EXPECT_FALSE(t.is_crossed({-10, -10, 20}, {90, 90, 20}));  // above
}

TEST(TriangleCrossing, OfARadioOnItIsThatOfARadioAbove) {
  const Triangle t{{0, 0, 10}, {100, 0, 10}, {0, 100, 10}};
  EXPECT_FALSE(t.is_crossed({20, 20, 10}, {20, 20, 20}));
  EXPECT_TRUE(t.is_crossed({20, 20, 10}, {20, 20, 0}));
  EXPECT_FALSE(t.is_crossed({20, 20, 10}, {30, 30, 10}));  // along it
}

// Radios really shifted: every difference of coordinates is a multiple of 2^27, and the shifts are so small that
// nonzero values keep their sign.
TEST(TriangleCrossing, IsThatOfRadiosShiftedUpEastAndNorth) {
  constexpr std::int64_t step = 1 << 27, up = 1 << 18, east = 1 << 9, north = 1;
  Drawing drawing(1);
  int degenerate = 0, crossed = 0;
  const auto shifted = [&](const Vector& p) { return Vector{p.x + east, p.y + north, p.z + up}; };
  for (int i = 0; i < 300000; ++i) {
    const Triangle t = drawing.triangle(8, step);
    const Vector p = drawing.point(8, step), q = drawing.point(8, step);
    const Vector normal = cross(t.b - t.a, t.c - t.a);
    degenerate += dot(normal, p - t.a) == 0 || dot(q - p, cross(t.a - p, t.b - p)) == 0;
    crossed += t.is_crossed(p, q);
    ASSERT_EQ(t.is_crossed(p, q), t.is_crossed(shifted(p), shifted(q)));
  }
  EXPECT_GT(degenerate, 10000);
  EXPECT_GT(crossed, 5000);
}

TEST(TriangleCrossing, IsTheSameBothWaysAndFromEitherFace) {
  Drawing drawing(2);
  for (int i = 0; i < 200000; ++i) {
    const Triangle t = drawing.triangle(6, 4096), turned{t.c, t.b, t.a}, rolled{t.b, t.c, t.a};
    const Vector p = drawing.point(6, 4096), q = drawing.point(6, 4096);
    ASSERT_EQ(t.is_crossed(p, q), t.is_crossed(q, p));
    ASSERT_EQ(t.is_crossed(p, q), turned.is_crossed(p, q));
    ASSERT_EQ(t.is_crossed(p, q), rolled.is_crossed(p, q));
  }
}

TEST(TriangleCrossing, OfALinkThatIsCutInTwoIsThatOfItsParts) {
  Drawing drawing(3);
  for (int i = 0; i < 200000; ++i) {
    const Triangle t = drawing.triangle(8, 2);
    const Vector p = drawing.point(8, 2), q = drawing.point(8, 2);
    const Vector middle{(p.x + q.x) / 2, (p.y + q.y) / 2, (p.z + q.z) / 2};
    ASSERT_EQ(t.is_crossed(p, q), t.is_crossed(p, middle) + t.is_crossed(middle, q));
  }
}

TEST(TriangleCrossing, OfAClosedSurfaceIsEvenOverARoundTrip) {
  Drawing drawing(4);
  long touched = 0;
  for (int i = 0; i < 60000; ++i) {
    const auto point = [&] { return drawing.point(5, 4096); };
    const auto body = tetrahedron(point(), point(), point(), point());
    const Vector p = point(), q = point(), r = point();
    const int way = crossings(body, p, q) + crossings(body, q, r) + crossings(body, r, p);
    ASSERT_EQ(way % 2, 0);
    touched += way > 0;
    // From outside, beyond all points of the body.
    const Vector far{p.x, p.y, 10 * 4096}, west{-4096, q.y, q.z};
    ASSERT_EQ(crossings(body, far, west) % 2, 0);
  }
  EXPECT_GT(touched, 10000);
}

TEST(TriangleCrossing, OfABoxIsTwoThroughItAndOneOutOfIt) {
  const auto body = box({0, 0, 0}, {40, 0, 0}, {0, 40, 0}, 40);
  for (const Vector& way : std::vector<Vector>{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {1, 1, 1}, {1, -1, 1}}) {
    const auto away = [&](int times) { return Vector{20 + times * way.x, 20 + times * way.y, 20 + times * way.z}; };
    EXPECT_EQ(crossings(body, away(-100), away(100)), 2);  // through edges and corners too
    EXPECT_EQ(crossings(body, away(0), away(100)), 1);
    EXPECT_EQ(crossings(body, away(-100), away(3)), 1);
  }
}

}  // namespace
}  // namespace muster
