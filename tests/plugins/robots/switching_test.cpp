#include "plugins/controllers/switching.hpp"

#include <gtest/gtest.h>

#include "plugins/periods.hpp"

namespace {

using namespace muster;

TEST(SwitchingTest, EveryFunctionRestsAtTheThresholdAndIsOdd) {
  for (const Switching kind : {Switching::linear, Switching::tanh, Switching::relay}) {
    EXPECT_EQ(switched(kind, 0), 0);
    double before = -1;
    for (double excess = -3; excess <= 3; excess += 0.01) {
      EXPECT_DOUBLE_EQ(switched(kind, excess), -switched(kind, -excess));
      EXPECT_GE(switched(kind, excess), before) << "never falls";
      before = switched(kind, excess);
    }
    EXPECT_GT(switched(kind, 3), 0.99);
  }
}

TEST(SwitchingTest, WithHysteresisItTurnsOnce) {
  bool has_turned = false;
  const auto on = [&](double excess) {
    return after_turning(switched(Switching::hysteresis, excess), excess, has_turned);
  };
  EXPECT_EQ(on(0.7), 0.7);
  EXPECT_EQ(on(-0.4), -0.4);
  EXPECT_EQ(on(0.7), 0) << "it rests on the near side";
  EXPECT_EQ(on(-0.1), -0.1);
  EXPECT_EQ(on(1), 1) << "a width above it goes on";
  EXPECT_EQ(on(0.2), 0.2);
}

TEST(SwitchingTest, AFollowerIsFreeLongBeforeTheThreshold) {
  EXPECT_EQ(wanted(8, 6), 0);
  EXPECT_EQ(wanted(6, 6), 0);
  EXPECT_DOUBLE_EQ(wanted(4.5, 6), 0.5);
  EXPECT_EQ(wanted(3, 6), 1);
  EXPECT_EQ(wanted(-20, 6), 1);
}

TEST(SwitchingTest, TheFilterForgetsWithItsTimeConstant) {
  EXPECT_NEAR(smoothed(0, 1, 2, 2), 1 - std::exp(-1), 1e-15);
  EXPECT_EQ(smoothed(0, 1, 2, 0), 1) << "no filter";
  double many = 0;
  for (int i = 0; i < 20; ++i) many = smoothed(many, 1, 0.1, 2);
  EXPECT_NEAR(many, smoothed(0, 1, 2, 2), 1e-12) << "whatever the interval between messages";
}

TEST(IsDue, OnceAPeriodHoweverTicksFall) {
  for (const double dt : {0.01, 0.05, 0.1, 0.5, 0.3}) {
    int count = 0;
    for (int tick = 1; tick * dt <= 60 + 1e-9; ++tick) count += is_due(tick * dt, dt, 0.5);
    EXPECT_EQ(count, 120) << dt;
  }
}

}  // namespace
