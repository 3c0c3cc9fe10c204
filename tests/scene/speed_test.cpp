// A measured data set of the usual size is counted without noticeable delay.
#include <gtest/gtest.h>

#include <ctime>

#include "drawing.hpp"

namespace muster::scene {
namespace {

TEST(Speed, TwentyThousandLinksThroughTwoHundredWallsTakeLessThanASecond) {
  SmallLattice lattice(41, 64);
  std::vector<Wall> walls;
  for (int i = 0; i < 200; ++i) {
    const double x = lattice.coordinate(), y = lattice.coordinate();
    walls.push_back(i % 2 == 0 ? wall(x, y, x + 6, y, 10) : wall(x, y, x, y + 6, 10));
  }
  const Scene scene(walls, {}, materials);
  std::vector<int> by_material(materials);
  long crossed = 0;
  const std::clock_t start = std::clock();
  for (int i = 0; i < 20'000; ++i) {
    const Point p{lattice.coordinate() + 0.3, lattice.coordinate() + 0.2, 1};
    const Point q{lattice.coordinate() + 0.4, lattice.coordinate() + 0.1, 1};
    scene.counts(p, q, by_material.data());
    crossed += by_material[0];
  }
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  RecordProperty("nanoseconds_a_link", std::to_string(seconds / 20'000 * 1e9));
  EXPECT_GT(crossed, 20'000);
  EXPECT_LT(seconds, 1);
}

}  // namespace
}  // namespace muster::scene
