// The timed path: rates are derivatives, and the limits hold.
#include <gtest/gtest.h>

#include <vector>

#include "plugins/controllers/timed_path.hpp"

namespace muster {
namespace {

TEST(Leg, IsATrapezoidOfSpeed) {
  const Leg leg(1, 1, 4);  // a quarter of a second to speed up in, 0.125 m on the way
  EXPECT_DOUBLE_EQ(leg.duration(), 1.25);
  EXPECT_DOUBLE_EQ(leg.at(0.25).s, 0.125);
  EXPECT_DOUBLE_EQ(leg.at(0.625).s, 0.5);
  EXPECT_DOUBLE_EQ(leg.at(0.625).v, 1);
  EXPECT_DOUBLE_EQ(leg.at(1.125).v, 0.5);
  EXPECT_DOUBLE_EQ(leg.at(2).s, 1);
  EXPECT_EQ(leg.at(2).v, 0);
}

TEST(Leg, TooShortForItsSpeedItTurnsRound) {
  const Leg leg(0.25, 10, 4);
  EXPECT_DOUBLE_EQ(leg.duration(), 0.5);
  EXPECT_DOUBLE_EQ(leg.at(0.25).v, 1);
  EXPECT_DOUBLE_EQ(leg.at(0.5 - 1e-9).s, 0.25);
  EXPECT_EQ(Leg(0, 1, 1).duration(), 0);
}

const std::vector<WayPoint3d> corner = {{0, 0, 1}, {3, 0, 1}, {3, 4, 1}};

TEST(TimedPath, RatesAreDerivativesWithinTheLimits) {
  const auto at = [](double t) { return timed_path(corner, t, 1.5, 2, 0.5, true); };
  constexpr double h = 1e-5;
  for (int i = 0; i < 2000; ++i) {
    const double t = 0.00731 * i;
    const Reference before = at(t - h), now = at(t), after = at(t + h);
    double speed = 0, acceleration = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR((after.place[k] - before.place[k]) / (2 * h), now.velocity[k], 1e-4) << t;
      speed += now.velocity[k] * now.velocity[k];
      acceleration += now.acceleration[k] * now.acceleration[k];
    }
    EXPECT_LE(speed, 1.5 * 1.5 * (1 + 1e-12));
    EXPECT_LE(acceleration, 4 * (1 + 1e-12));
  }
}

TEST(TimedPath, WaitsAtEachPointAndEndsOrLoops) {
  const double leg = 3 / 1.5 + 0.75;
  const auto at = [](double t, bool loop) { return timed_path(corner, t, 1.5, 2, 0.5, loop).place; };
  EXPECT_EQ(at(-1, false), (Vector{0, 0, 1}));
  EXPECT_EQ(at(0.5, false), (Vector{0, 0, 1}));
  EXPECT_EQ(at(0.5 + leg + 0.25, false), (Vector{3, 0, 1}));
  EXPECT_EQ(at(100, false), (Vector{3, 4, 1}));
  const double round = 1.5 + leg + (4 / 1.5 + 0.75) + (5 / 1.5 + 0.75);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(at(1.7, true)[k], at(1.7 + 3 * round, true)[k], 1e-12);
  EXPECT_EQ(timed_path(std::vector<WayPoint3d>{{1, 2, 3}}, 5, 1, 1, 1, true).place, (Vector{1, 2, 3}));
}

}  // namespace
}  // namespace muster
