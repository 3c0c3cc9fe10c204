// Links that a wall or a thing may concern are selected many at a time: none that it takes a level from is left out,
// and vectors of any width select the same.
#include "plugins/causes/plan_shapes.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <muster/widest.hpp>
#include <random>
#include <tuple>

namespace muster {
namespace {

// Links between random places of a lattice, on which ends meet walls and each other; every seventh is upright.
struct RandomLinks {
  PlanEnds ends;
  std::array<Pose, PlanEnds::most> first, second;  // in the order of LinkTerm::add_both_ways()

  explicit RandomLinks(std::mt19937_64& random) {
    std::uniform_int_distribution<int> coordinate(-8, 8);
    const auto place = [&] { return Pose{coordinate(random) * 0.5, coordinate(random) * 0.5, 1, 1, 0, 0, 0}; };
    for (std::size_t i = 0; i < PlanEnds::most; ++i) {
      const Pose a = place(), b = i % 7 ? place() : a;
      ends.ax[i] = a.x, ends.ay[i] = a.y, ends.bx[i] = b.x, ends.by[i] = b.y;
      const bool turned = std::tie(b.x, b.y) < std::tie(a.x, a.y);
      first[i] = turned ? b : a;
      second[i] = turned ? a : b;
    }
  }
};

TEST(PlanShapes, NoLinkThatAWallConcernsIsLeftOut) {
  using Meets = Widest<MeetsSegment, const PlanEnds&, std::size_t, const Segment&, double, double*>;
  std::mt19937_64 random(11);
  std::uniform_int_distribution<int> coordinate(-6, 6);
  int met_by_all = 0, concerned = 0;
  for (int k = 0; k < 400; ++k) {
    const RandomLinks links(random);
    const auto at = [&] { return coordinate(random) * 0.5; };
    const Segment wall{at(), at(), k % 20 ? at() : 1, k % 20 ? at() : 1};
    const double edge = k % 3 * 0.4;
    std::array<double, PlanEnds::most> plain{};
    const auto functions = Meets::all();
    for (int width = 0; width < functions.number; ++width) {
      std::array<double, PlanEnds::most> met{};
      const std::size_t count = PlanEnds::most - static_cast<std::size_t>(k) % 5;
      functions.of[width](links.ends, count, wall, edge, met.data());
      if (width == 0) plain = met;
      ASSERT_EQ(met, plain) << width;
    }
    for (std::size_t i = 0; i < PlanEnds::most - 5; ++i) {
      const double share = wall.share(links.first[i], links.second[i], 2, edge);
      if (share > 0) {
        ASSERT_NE(plain[i], 0) << k << ' ' << i;
      }
      concerned += share > 0;
      met_by_all += plain[i] != 0;
    }
  }
  EXPECT_GT(concerned, 5000);
  EXPECT_LT(met_by_all, 1.3 * concerned);
}

TEST(PlanShapes, NoLinkThatAThingConcernsIsLeftOut) {
  using Meets = Widest<MeetsDisk, const PlanEnds&, std::size_t, const Disk&, double*>;
  std::mt19937_64 random(12);
  std::uniform_real_distribution<double> coordinate(-4, 4), radius(0.05, 2);
  int met_by_all = 0, concerned = 0;
  for (int k = 0; k < 400; ++k) {
    const RandomLinks links(random);
    const Disk thing{coordinate(random), coordinate(random), radius(random)};
    std::array<double, PlanEnds::most> plain{};
    const auto functions = Meets::all();
    for (int width = 0; width < functions.number; ++width) {
      std::array<double, PlanEnds::most> met{};
      functions.of[width](links.ends, PlanEnds::most, thing, met.data());
      if (width == 0) plain = met;
      ASSERT_EQ(met, plain) << width;
    }
    for (std::size_t i = 0; i < PlanEnds::most; ++i) {
      const double way = thing.way(links.first[i], links.second[i], 2);
      if (way > 0) {
        ASSERT_NE(plain[i], 0) << k << ' ' << i;
      }
      concerned += way > 0;
      met_by_all += plain[i] != 0;
    }
  }
  EXPECT_GT(concerned, 5000);
  EXPECT_LT(met_by_all, 3 * concerned) << "the line through both ends may meet it beyond them";
}

}  // namespace
}  // namespace muster
