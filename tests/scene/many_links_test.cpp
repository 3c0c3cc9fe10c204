// Many links at once: the same counts as one at a time, for any instruction set, order and company.
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>

#include "adversary.hpp"

namespace muster::scene {
namespace {

TEST(ManyLinks, AgreeWithTheTwinOnHalfAMillion) { EXPECT_GT(compare_with_twin(1, 500), 500'000); }

TEST(ManyLinks, AgreeWithShiftedRadiosOnHalfAMillion) { EXPECT_GT(compare_with_shifted_radios(2, 50), 500'000); }

// Large enough for receivers to be sorted by direction, and split in halves.
TEST(ManyLinks, AgreeWithShiftedRadiosOnLargeFloors) { EXPECT_GT(compare_with_shifted_radios(3, 5, 30, 30), 50'000); }

// The results do not depend on the vector width, so each width of this machine must be compared.
TEST(ManyLinks, AreCountedByEveryKernelOfThisMachine) {
#ifdef __x86_64__
  EXPECT_EQ(wall_kernels().number, 1 + !!__builtin_cpu_supports("x86-64-v3") + !!__builtin_cpu_supports("x86-64-v4"));
#endif
  EXPECT_EQ(&best_wall_kernel(), wall_kernels().all[wall_kernels().number - 1]);
}

// A large hall, with radios far and near: enough walls for receivers to be sorted by direction, and for a tree of three
// levels.
TEST(ManyLinks, AgreeInALargeScene) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-400, 400), shift(-8, 8);
  std::vector<Wall> walls;
  for (int i = 0; i < 4200; ++i) {
    const double x = place(random), y = place(random);
    walls.push_back(wall(x, y, x + shift(random), y + shift(random), 3, i % materials));
  }
  const Scene scene(walls, {}, materials);
  std::vector<Point> points;
  for (int i = 0; i < 120; ++i) points.push_back({place(random), place(random), 1});
  int crossed = 0;
  EXPECT_TRUE(agree(scene, points, all_pairs(points.size()), [&](const Pair& link, int* by_material) {
    scene.counts(points[link.from], points[link.to], by_material);
    crossed += by_material[0];
  }));
  EXPECT_GT(crossed, 30'000);
}

TEST(ManyLinks, DependOnNoOrder) {
  Storey storey(4);
  const Scene scene(storey.walls, storey.doors, materials);
  std::vector<Point> points;
  for (int i = 0; i < 60; ++i) points.push_back(storey.point());
  auto links = all_pairs(points.size());
  std::vector<int> counted, shuffled;
  scene.counts(points, links, counted);
  std::vector<std::uint32_t> order(links.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  std::shuffle(order.begin(), order.end(), std::mt19937(5));
  std::vector<Pair> mixed;
  for (const auto i : order) mixed.push_back(links[i]);
  scene.counts(points, mixed, shuffled);
  for (int m = 0; m < materials; ++m) {
    for (std::size_t i = 0; i < order.size(); ++i) {
      ASSERT_EQ(shuffled[m * order.size() + i], counted[m * order.size() + order[i]]);
    }
  }
}

TEST(ManyLinks, AreTheSameBothWays) {
  Storey storey(6);
  const Scene scene(storey.walls, storey.doors, materials);
  std::vector<Point> points;
  for (int i = 0; i < 200; ++i) points.push_back(storey.point());
  const std::size_t n = points.size();
  std::vector<int> counted;
  scene.counts(points, all_pairs(n), counted);
  for (int m = 0; m < materials; ++m) {
    for (std::size_t a = 0; a < n; ++a) {
      for (std::size_t b = 0; b < a; ++b) ASSERT_EQ(counted[(m * n + a) * n + b], counted[(m * n + b) * n + a]);
    }
  }
}

TEST(ManyLinks, FollowDoors) {
  Storey storey(7);
  Scene scene(storey.walls, storey.doors, materials);
  std::vector<Point> points;
  for (int i = 0; i < 40; ++i) points.push_back(storey.point());
  const auto links = all_pairs(points.size());
  std::vector<int> before, after;
  scene.counts(points, links, before);
  for (std::size_t door = 0; door < storey.doors.size(); ++door) {
    scene.set_open(static_cast<int>(door), !storey.doors[door].open);
  }
  scene.counts(points, links, after);
  EXPECT_NE(before, after);
  EXPECT_TRUE(agree(scene, points, links, [&](const Pair& link, int* by_material) {
    scene.counts(points[link.from], points[link.to], by_material);
  }));
}

TEST(ManyLinks, AreNoneWithoutWallsMaterialsOrLinks) {
  const Scene empty({}, {}, 1), bare({}, {}, 0);
  std::vector<Point> points;
  for (int i = 0; i < 20; ++i) points.push_back({1.0 * i, 2, 1});
  std::vector<int> counted{1};
  empty.counts(points, all_pairs(20), counted);
  EXPECT_EQ(counted, std::vector<int>(400, 0));
  bare.counts(points, all_pairs(20), counted);
  EXPECT_TRUE(counted.empty());
  empty.counts({}, {}, counted);
  EXPECT_TRUE(counted.empty());
}

TEST(ManyLinks, RefuseAPointBeyondTheScene) {
  const Scene scene({wall(0, 0, 1, 0)}, {}, materials);
  std::vector<int> counted;
  EXPECT_THROW(scene.counts({{0, 0, 0}, {200000, 0, 0}}, {}, counted), std::runtime_error);
}

// Every radio is moved by 2^-100 of a lattice step to the east and 2^-200 to the north, and then nothing is a tie.
TEST(OneLink, AgreesWithRationalNumbersOnTheWholeLattice) {
  using Exact = boost::multiprecision::number<boost::multiprecision::cpp_int_backend<
      640, 640, boost::multiprecision::signed_magnitude, boost::multiprecision::unchecked, void>>;
  struct Vector {
    Exact x, y;
  };
  const auto at = [](double x, double y, int moved) {
    return Vector{(Exact(snap(x)) << 200) + (Exact(moved) << 100), (Exact(snap(y)) << 200) + Exact(moved)};
  };
  const auto side = [](const Vector& a, const Vector& b, const Vector& c) {
    const Exact value = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    EXPECT_NE(value, 0);
    return value > 0;
  };
  int crossed = 0;
  for (unsigned seed = 0; seed < 12; ++seed) {
    Storey storey(seed);
    for (Wall& wall : storey.walls) wall.base = 0;
    const Scene scene(storey.walls, {}, materials);
    for (int i = 0; i < 40; ++i) {
      Point p = storey.point(), q = storey.point();
      if (i % 10 == 0) q = p;
      p.z = q.z = 0.5;  // within every wall's height
      const Vector from = at(p.x, p.y, 1), to = at(q.x, q.y, 1);
      const bool moves = from.x != to.x || from.y != to.y;
      std::vector<int> expected(materials, 0);
      for (const Wall& wall : storey.walls) {
        const Vector a = at(wall.x0, wall.y0, 0), b = at(wall.x1, wall.y1, 0);
        if (moves && side(from, to, a) != side(from, to, b) && side(a, b, from) != side(a, b, to)) {
          ++expected[wall.material];
          ++crossed;
        }
      }
      ASSERT_EQ(counts(scene, p, q), expected) << text(p) << text(q);
    }
  }
  EXPECT_GT(crossed, 1000);
}

}  // namespace
}  // namespace muster::scene
