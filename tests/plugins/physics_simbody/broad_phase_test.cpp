// The pairs equal those of comparing all with all.
#include "broad_phase.hpp"

#include <gtest/gtest.h>

#include <random>

namespace muster::simbody {
namespace {

std::vector<Extent> random_extents(std::mt19937& random, int count, double size) {
  const auto draw = [&](double most) { return most * static_cast<double>(random()) / 4294967296.0; };
  std::vector<Extent> result;
  for (int i = 0; i < count; ++i) {
    // On a coarse lattice, so that many begin and end at one place.
    const Eigen::Vector3d low(std::floor(draw(20)), std::floor(draw(20)), std::floor(draw(3)));
    result.push_back({low, low + Eigen::Vector3d(std::floor(draw(size)), std::floor(draw(size)), draw(2))});
  }
  return result;
}

TEST(BroadPhase, FindsWhatComparingAllFinds) {
  std::mt19937 random(1);
  BroadPhase sweep;
  std::size_t found = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const auto standing = random_extents(random, 30, 12), moving = random_extents(random, trial % 40, 3);
    sweep.set_standing(standing);
    BroadPhase::Pairs among, with_standing;
    for (int i = 0; i < static_cast<int>(moving.size()); ++i) {
      for (int j = i + 1; j < static_cast<int>(moving.size()); ++j) {
        if (moving[i].overlaps(moving[j])) among.push_back({i, j});
      }
      for (int j = 0; j < static_cast<int>(standing.size()); ++j) {
        if (moving[i].overlaps(standing[j])) with_standing.push_back({i, j});
      }
    }
    sweep.find(moving);
    EXPECT_EQ(sweep.among(), among);
    EXPECT_EQ(sweep.with_standing(), with_standing);
    found += among.size() + with_standing.size();
  }
  EXPECT_GT(found, 1000u);
}

TEST(BroadPhase, OverlapNeedsEveryAxis) {
  const Extent a{{0, 0, 0}, {1, 1, 1}};
  EXPECT_TRUE(a.overlaps({{1, 1, 1}, {2, 2, 2}}));
  for (int axis = 0; axis < 3; ++axis) {
    Extent b = a;
    b.low[axis] += 1.5, b.high[axis] += 1.5;
    EXPECT_FALSE(a.overlaps(b));
    EXPECT_FALSE(b.overlaps(a));
  }
}

}  // namespace
}  // namespace muster::simbody
