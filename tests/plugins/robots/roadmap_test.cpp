#include "plugins/controllers/roadmap.hpp"

#include <gtest/gtest.h>

#include "plugins/robots/dead_reckoning.hpp"

namespace {

using namespace muster;

const Roadmap corner(std::vector<Waypoint>{{0, 0}, {4, 0}, {4, 3}});

TEST(RoadmapTest, PlacesByArclength) {
  EXPECT_DOUBLE_EQ(corner.length(), 7);
  EXPECT_DOUBLE_EQ(corner.at(5).x, 4);
  EXPECT_DOUBLE_EQ(corner.at(5).y, 1);
  EXPECT_DOUBLE_EQ(corner.at(4).x, 4);
  EXPECT_DOUBLE_EQ(corner.at(9).y, 5) << "prolonged past the end";
  EXPECT_DOUBLE_EQ(corner.at(-1).x, -1) << "and before the start";
}

TEST(RoadmapTest, ArclengthByPlacesWithinAWindow) {
  EXPECT_DOUBLE_EQ(corner.nearest({2, 0.5}, 0, 7), 2);
  EXPECT_DOUBLE_EQ(corner.nearest({5, 2}, 0, 7), 6);
  EXPECT_DOUBLE_EQ(corner.nearest({4, 2.9}, 1, 3), 3) << "no further than the window";
  EXPECT_DOUBLE_EQ(corner.nearest({-3, 0}, 0, 7), 0);
  EXPECT_DOUBLE_EQ(corner.nearest({4, 8}, 6, 8), 7);
}

TEST(RoadmapTest, EveryPlaceOnItHasItsArclength) {
  for (double s = 0; s <= 7; s += 0.01) EXPECT_NEAR(corner.nearest(corner.at(s), s - 1, s + 1), s, 1e-12);
}

TEST(RoadmapTest, RefusesWhatIsNoWay) {
  EXPECT_THROW(Roadmap(std::vector<Waypoint>{{0, 0}}), BadInput);
  EXPECT_THROW(Roadmap(std::vector<Waypoint>{{0, 0}, {1, 1}, {1, 1}}), BadInput);
}

// The largest distance from the roadmap of a robot that pursues it at speed v from its start.
double worst_deviation(Odometry at, double s, double v, double seconds) {
  constexpr double dt = 0.05, lookahead = 0.6;
  double worst = 0;
  for (double t = 0; t < seconds; t += dt) {
    s = corner.nearest({at.x, at.y}, s - 1, s + 1);
    worst = std::max(worst, Roadmap::distance({at.x, at.y}, corner.at(s)));
    const Command c = pursuit(at, corner.at(s + std::copysign(lookahead, v)), v, 0.8);
    roll(at, c.v * dt, c.w * dt);
  }
  return worst;
}

TEST(Pursuit, StaysOnTheRoadmapForwardsAndBackwards) {
  EXPECT_LT(worst_deviation({0, 0, 0, 0, 0}, 0, 0.3, 20), 0.2);
  EXPECT_LT(worst_deviation({4, 3, 1.5707963, 0, 0}, 7, -0.3, 20), 0.2);
}

TEST(Pursuit, TurnsOnTheSpotTowardsWhatLiesAside) {
  const Command left = pursuit({0, 0, 0, 0, 0}, {-1, 0.1}, 0.3, 0.8);
  EXPECT_EQ(left.v, 0);
  EXPECT_EQ(left.w, 0.8);
  EXPECT_EQ(pursuit({0, 0, 0, 0, 0}, {-1, -0.1}, 0.3, 0.8).w, -0.8);
  EXPECT_LT(pursuit({0, 0, 0, 0, 0}, {-1, 0}, -0.3, 0.8).v, 0) << "backwards, what lies behind lies ahead";
}

TEST(Pursuit, AtRestAsksForNothing) {
  const Command rest = pursuit({0, 0, 0, 0, 0}, {-1, 1}, 0, 0.8);
  EXPECT_EQ(rest.v, 0);
  EXPECT_EQ(rest.w, 0);
}

}  // namespace
