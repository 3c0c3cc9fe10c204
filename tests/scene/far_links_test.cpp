// Radios beyond the lattice: their links cross what a plain computation in long double finds.
#include "scene/far_links.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "drawing.hpp"

namespace muster::scene {
namespace {

using Real = long double;

struct Clear {
  bool crosses = false, is_clear = false;  // not clear: within a millimetre of the wall's ends, base or top
};

Clear plain(const Wall& w, const Point& p, const Point& q) {
  const Real dx = Real{q.x} - p.x, dy = Real{q.y} - p.y, wx = Real{w.x1} - w.x0, wy = Real{w.y1} - w.y0;
  const Real across = dx * wy - dy * wx;
  if (std::abs(across) < 1e-3L * std::hypot(dx, dy)) return {};
  const Real along = ((w.x0 - p.x) * wy - (w.y0 - p.y) * wx) / across,
             of_wall = ((w.x0 - p.x) * dy - (w.y0 - p.y) * dx) / across, z = p.z + along * (Real{q.z} - p.z);
  const Real length = std::hypot(wx, wy), slack = 1e-3L * std::hypot(dx, dy) / std::abs(across) * length;
  const auto near = [](Real value, Real edge, Real by) { return std::abs(value - edge) < by; };
  if (near(of_wall, 0, slack) || near(of_wall, 1, slack) || near(along, 0, 1e-6L) || near(along, 1, 1e-6L)) return {};
  if (near(z, w.base, 5e-3L) || near(z, w.base + w.height, 5e-3L)) return {};
  return {along > 0 && along < 1 && of_wall > 0 && of_wall < 1 && z > w.base && z < w.base + w.height, true};
}

TEST(FarLinks, CrossWhatAPlainComputationFinds) {
  std::mt19937_64 random(35);
  const auto within = [&](double size) { return std::uniform_real_distribution(-size, size)(random); };
  std::vector<Wall> walls;
  for (int k = 0; k < 60; ++k) {
    const double x = within(900), y = within(900);
    walls.push_back({x, y, x + within(90), y + within(90), within(5), 3 + std::abs(within(20)), 0.1, k % materials});
  }
  const Scene scene(walls, {}, materials);
  int crossed = 0, passing = 0;
  for (int n = 0; n < 4000; ++n) {
    const double size = n % 2 ? 100000 : 5000;
    const Point p =
        n % 3 ? Point{within(900), within(900), within(10)} : Point{within(size), within(size), within(size / 50)};
    const Point q =
        n % 3 ? Point{within(size), within(size), within(30)} : Point{-p.x + within(900), -p.y + within(900), -p.z};
    std::vector<int> expected(walls.size()), found(walls.size());
    for (const Crossing& c : crossings(scene, p, q)) ++found[static_cast<std::size_t>(c.wall)];
    for (std::size_t w = 0; w < walls.size(); ++w) {
      const Clear clear = plain(walls[w], p, q);
      if (clear.is_clear) {
        EXPECT_EQ(found[w], clear.crosses) << n << " wall " << w;
      }
      crossed += found[w];
    }
    passing += !near_part(p, q);
    EXPECT_EQ(counts(scene, p, q), counts(scene, q, p));
  }
  EXPECT_GT(crossed, 1000);
  EXPECT_LT(passing, 4000);
}

TEST(FarLinks, ManyAtOnceCountTheSame) {
  std::mt19937_64 random(36);
  const auto within = [&](double size) { return std::uniform_real_distribution(-size, size)(random); };
  std::vector<Wall> walls;
  for (int k = 0; k < 40; ++k) {
    const double x = within(900), y = within(900);
    walls.push_back(wall(x, y, x + within(90), y + within(90), 30, k % materials));
  }
  const Scene scene(walls, {}, materials, {{{-50, 50, 50, -50}, {-50, -50, 50, 50}, 3, 1}});
  std::vector<Point> points;
  for (int k = 0; k < 60; ++k) points.push_back({within(k % 3 ? 900 : 50000), within(k % 3 ? 900 : 50000), within(20)});
  std::vector<Pair> links;
  for (std::uint32_t a = 0; a < points.size(); ++a) {
    for (std::uint32_t b = 0; b < points.size(); ++b) {
      if (a != b) links.push_back({a, b});
    }
  }
  std::vector<int> all;
  scene.counts(points, links, all);
  int sum = 0;
  for (std::size_t i = 0; i < links.size(); ++i) {
    const auto one = counts(scene, points[links[i].from], points[links[i].to]);
    for (int m = 0; m < materials; ++m) {
      const int of_many = all[static_cast<std::size_t>(m) * links.size() + i];
      ASSERT_EQ(of_many, one[static_cast<std::size_t>(m)]) << i;
      sum += of_many;
    }
  }
  EXPECT_GT(sum, 500);
  EXPECT_EQ(spatial_order(points).size(), points.size());
}

TEST(FarLinks, FractionsAreOfTheWholeLink) {
  const Scene scene({wall(500, -5, 500, 5, 30)}, {}, materials);
  const auto there = crossings(scene, {0, 0, 1}, {50000, 0, 1}), back = crossings(scene, {50000, 0, 1}, {0, 0, 1});
  ASSERT_EQ(there.size(), 1u);
  ASSERT_EQ(back.size(), 1u);
  EXPECT_NEAR(there[0].fraction, 0.01, 1e-9);
  EXPECT_NEAR(back[0].fraction, 0.99, 1e-9);
  EXPECT_NEAR(there[0].z, 1, 1e-3);
  EXPECT_DOUBLE_EQ(there[0].cos_incidence, back[0].cos_incidence);
}

TEST(FarLinks, PassOutsideOfEverything) {
  EXPECT_FALSE(near_part({5000, -5000, 0}, {5000, 5000, 0}));
  EXPECT_FALSE(near_part({0, 0, 2000}, {5, 5, 9000}));
  const auto through = near_part({-5000, 0, 0}, {5000, 0, 0});
  ASSERT_TRUE(through);
  EXPECT_NEAR(through->from.x, -1000, 0.001);
  EXPECT_NEAR(through->begin, 0.4, 1e-6);
  EXPECT_THROW(near_part({0, 0, 0}, {100001, 0, 0}), std::runtime_error);
}

}  // namespace
}  // namespace muster::scene
