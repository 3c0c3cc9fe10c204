// Reflections in geometries with images in closed form: one wall, a corner, a corridor; and the laws of reciprocity and
// energy.
#include <gtest/gtest.h>

#include <cmath>
#include <muster/random.hpp>
#include <vector>

#include "radio_images/image_paths.hpp"

namespace muster {
namespace {

using scene::Door;
using scene::Point;
using scene::Wall;

Wall wall(double x0, double y0, double x1, double y1, int material = 0) {
  return {x0, y0, x1, y1, 0, 3, 0.1, material};
}

std::vector<ImagePath> ways(const std::vector<Wall>& walls, const Point& p, const Point& q, int bounces = 1,
                            const std::vector<Door>& doors = {}, double permittivity = 5,
                            const std::vector<scene::Floor>& floors = {}) {
  ImagePaths paths(walls, doors, floors, {6, 11});
  std::vector<ImagePath> result;
  paths.visit(p, q, bounces, permittivity, [&](const ImagePath& way) { result.push_back(way); });
  return result;
}

TEST(Fresnel, IsKnownHeadOnAndAlongTheWall) {
  EXPECT_DOUBLE_EQ(fresnel_upright(1, 4), (1 - 2.0) / (1 + 2.0));
  EXPECT_DOUBLE_EQ(fresnel_upright(0, 4), -1);
  EXPECT_EQ(fresnel_upright(0.4, 1), 0);  // a wall of air
  for (double cosine = 0.05; cosine < 1; cosine += 0.05) {
    EXPECT_LT(fresnel_upright(cosine, 5), 0);
    EXPECT_GT(fresnel_upright(cosine, 5), fresnel_upright(cosine - 0.05, 5));
    // Energy: the rest is transmitted, (1 + R)^2 times the ratio of the two cosines and indices.
    const double r = fresnel_upright(cosine, 5), inside = std::sqrt(5 - 1 + cosine * cosine);
    EXPECT_NEAR(r * r + (1 + r) * (1 + r) * inside / cosine, 1, 1e-14);
  }
}

TEST(Images, OneWallHasOneOfThem) {
  // A wall along y = 0; the image of (0, 3) is (0, -3).
  const auto found = ways({wall(-10, 0, 10, 0)}, {0, 3, 1}, {4, 5, 2});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].length, std::sqrt(16 + 64 + 1.0), 1e-14);
  EXPECT_NEAR(found[0].reflection, fresnel_upright(8 / std::sqrt(81.0), 5), 1e-14);
  EXPECT_EQ(found[0].walls, 0);
  EXPECT_EQ(found[0].mirrors, 1);
}

TEST(Images, AreSeenOnlyWhereThereIsWall) {
  const Point p{0, 3, 1}, q{4, 5, 1};  // the mirror point is (1.5, 0, 1)
  EXPECT_EQ(ways({wall(1.4, 0, 1.6, 0)}, p, q).size(), 1u);
  EXPECT_EQ(ways({wall(1.6, 0, 9, 0)}, p, q).size(), 0u);
  EXPECT_EQ(ways({wall(1.4, 0, -9, 0)}, p, q).size(), 0u);
  EXPECT_EQ(ways({wall(-10, 0, 10, 0)}, p, {4, -5, 1}).size(), 0u);         // on its other side
  EXPECT_EQ(ways({wall(-10, 0, 10, 0)}, {0, 3, 4}, {4, 5, 4}).size(), 0u);  // over it
  const std::vector<Door> shut{{0, 11, 1, 2, 1, false}}, open{{0, 11, 1, 2, 1, true}}, beside{{0, 12, 1, 2, 1, true}};
  EXPECT_EQ(ways({wall(-10, 0, 10, 0)}, p, q, 1, shut).size(), 1u);
  EXPECT_EQ(ways({wall(-10, 0, 10, 0)}, p, q, 1, open).size(), 0u);
  EXPECT_EQ(ways({wall(-10, 0, 10, 0)}, p, q, 1, beside).size(), 1u);
  EXPECT_EQ(ways({wall(-10, 0, 10, 0)}, {0, 3, 2.5}, {4, 5, 2.5}, 1, open).size(), 1u);  // over the door
}

TEST(Images, ACornerHasTwoAndOneBehindIt) {
  // Walls along both axes. By both, the image is the point reflected at the corner, in either order: for any two places
  // one order is possible and the other is not.
  const std::vector<Wall> corner{wall(0, 0, 100, 0), wall(0, 0, 0, 100)};
  const Stream random(1);
  for (uint64_t i = 0; i < 500; ++i) {
    const Point p{0.1 + 20 * random.uniform(i, 0), 0.1 + 20 * random.uniform(i, 1), 1};
    const Point q{0.1 + 20 * random.uniform(i, 2), 0.1 + 20 * random.uniform(i, 3), 1};
    std::vector<double> lengths;
    for (const ImagePath& way : ways(corner, p, q, 2)) {
      if (way.mirrors == 2) {
        EXPECT_NEAR(way.length, std::hypot(p.x + q.x, p.y + q.y), 1e-12);
        // A ray leaves a right corner antiparallel: the angles to the two walls add up to a right one.
        const double along = (p.x + q.x) / way.length, up = (p.y + q.y) / way.length;
        EXPECT_NEAR(way.reflection, fresnel_upright(along, 5) * fresnel_upright(up, 5), 1e-12);
      }
      lengths.push_back(way.length);
      EXPECT_EQ(way.walls, 0);
    }
    EXPECT_EQ(lengths.size(), 3u);
  }
}

TEST(Images, InACorridorBouncesBetweenItsWalls) {
  // Walls at y = 0 and y = 2 of no end: images at -y, 4 - y, and after two bounces y + 4 and y - 4.
  const std::vector<Wall> corridor{wall(-500, 0, 500, 0), wall(-500, 2, 500, 2)};
  const auto found = ways(corridor, {0, 0.5, 1}, {30, 1.25, 1}, 2);
  std::vector<double> lengths;
  for (const ImagePath& way : found) lengths.push_back(way.length);
  std::sort(lengths.begin(), lengths.end());
  std::vector<double> expected;
  for (const double image : {-0.5, 3.5, 4.5, -3.5}) expected.push_back(std::hypot(30, image - 1.25));
  std::sort(expected.begin(), expected.end());
  ASSERT_EQ(lengths.size(), expected.size());
  for (std::size_t i = 0; i < lengths.size(); ++i) EXPECT_NEAR(lengths[i], expected[i], 1e-12);
}

TEST(Images, PayForTheWallsInTheirWay) {
  // A mirror at y = 0, a screen of 11 dB in the first leg and one of 6 dB in the second, and one in neither.
  const std::vector<Wall> walls{wall(-10, 0, 10, 0), wall(0, 1, 2, 1, 1), wall(2.5, 1, 3.5, 1, 0), wall(-5, 1, -4, 1)};
  std::vector<ImagePath> by_mirror;
  for (const ImagePath& way : ways(walls, {0, 2, 1}, {4, 2, 1})) {
    if (std::abs(way.length - std::sqrt(32)) < 1e-9) by_mirror.push_back(way);
  }
  ASSERT_EQ(by_mirror.size(), 1u);
  EXPECT_EQ(by_mirror[0].walls, 17);
}

// By a mirror whose whole height can be seen, from one storey to the next.
TEST(Images, PayForTheFloorsInTheirWay) {
  std::vector<Wall> mirror{wall(-10, 0, 10, 0)};
  mirror[0].height = 6;
  const scene::Floor here{{-10, 10, 10, -10}, {0, 0, 5, 5}, 3, 1}, elsewhere{{5, 10, 10, 5}, {0, 0, 5, 5}, 3, 0};
  const auto by_mirror = ways(mirror, {0, 2, 2}, {4, 2, 5}, 1, {}, 5, {here, elsewhere});
  ASSERT_EQ(by_mirror.size(), 1u);
  EXPECT_EQ(by_mirror[0].walls, 11);
}

// In a field of a point source and a mirror, the power averaged over fringes is the sum of the two powers.
TEST(Images, PowerAveragedOverFringesIsTheSumOfPowers) {
  const std::vector<Wall> walls{wall(-400, 0, 400, 0)};
  ImagePaths paths(walls, {}, {}, {6, 11});
  const double number = 6.283185307179586 / 0.123;
  const Stream random(2);
  double coherent = 0, incoherent = 0;
  for (uint64_t i = 0; i < 20000; ++i) {
    const Point p{0, 6, 1}, q{20 + 2 * random.uniform(i, 0), 6 + 2 * random.uniform(i, 1), 1};
    const double direct = std::hypot(q.x, q.y - 6);
    double re = std::cos(number * direct) / direct, im = std::sin(number * direct) / direct,
           sum = 1 / (direct * direct);
    paths.visit(p, q, 1, 5, [&](const ImagePath& way) {
      const double share = way.reflection / way.length;
      re += share * std::cos(number * way.length), im += share * std::sin(number * way.length), sum += share * share;
    });
    coherent += re * re + im * im;
    incoherent += sum;
  }
  EXPECT_NEAR(coherent / incoherent, 1, 0.01);
}

}  // namespace
}  // namespace muster
