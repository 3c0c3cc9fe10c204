#include "plugins/robots/tripod_gait.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace {

using namespace muster;

TEST(TripodGait, LegsAreSlowInStanceAndComeAround) {
  constexpr double duty = 0.65, sweep = 0.8;
  EXPECT_DOUBLE_EQ(clock_angle(0, sweep, duty), 0);
  EXPECT_DOUBLE_EQ(clock_angle(duty / 2, sweep, duty), sweep / 2);
  EXPECT_NEAR(clock_angle(7 - duty / 2, sweep, duty), -sweep / 2, 1e-12);
  const double swing = (whole_turn - sweep) / (1 - duty);
  EXPECT_NEAR(clock_angle(0.5, sweep, duty) - clock_angle(0.4, sweep, duty), -whole_turn + 0.1 * swing, 1e-12);
  for (double phase = 0; phase < 1; phase += 0.01) {
    EXPECT_NEAR(clock_angle(phase, -sweep, duty), -clock_angle(phase, sweep, duty), 1e-12);  // backwards
    EXPECT_NEAR(clock_angle(-phase, sweep, duty), -clock_angle(phase, sweep, duty), 1e-12);
    const double ahead =
        std::remainder(clock_angle(phase + 1e-6, sweep, duty) - clock_angle(phase, sweep, duty), whole_turn);
    EXPECT_GT(ahead, 0);
    EXPECT_LE(ahead, 1.001e-6 * swing);
  }
}

TEST(TripodGait, SweepsMeetWhereTheyMayChange) {
  for (const double sweep : {-1.2, -0.4, 0.0, 0.3, 1.0}) {
    EXPECT_DOUBLE_EQ(clock_angle(3, sweep, 0.65), 0);
    EXPECT_NEAR(std::abs(std::remainder(clock_angle(0.5, sweep, 0.65), whole_turn)), whole_turn / 2, 1e-12);
  }
}

// The body as a point over two legs, each of which would carry its hip at a height: the higher one carries it, without
// slip.
TEST(TripodGait, StrideIsThatOfRollingLegs) {
  const double radius = 0.06;
  const auto height = [&](double x) { return x > 0 ? 2 * radius * std::cos(x) : radius * (1 + std::cos(x)); };
  const auto way = [&](double x) { return x > 0 ? 2 * radius * std::sin(x) : radius * (x + std::sin(x)); };
  for (const double duty : {0.6, 0.65, 0.8}) {
    for (const double sweep : {0.3, 1.0, 1.2}) {
      double travelled = 0;
      constexpr int steps = 200000;
      for (int k = 0; k < steps; ++k) {
        double best = -1, gain = 0;
        for (const double shift : {0.0, 0.5}) {
          const double from = std::remainder(clock_angle(shift + double(k) / steps, sweep, duty), whole_turn);
          const double to = std::remainder(clock_angle(shift + double(k + 1) / steps, sweep, duty), whole_turn);
          const double middle = height((from + to) / 2);
          if (std::abs(to - from) < 1 && middle > best) best = middle, gain = way(to) - way(from);
        }
        travelled += gain;
      }
      EXPECT_NEAR(stride_of(sweep, duty, radius), travelled, 1e-5) << duty << ' ' << sweep;
    }
  }
}

TEST(TripodGait, SweepOfAStrideIsItsInverse) {
  for (const double sweep : {-1.2, -0.01, 0.5, 1.0}) {
    EXPECT_NEAR(sweep_of(stride_of(sweep, 0.65, 0.06), 0.65, 0.06), sweep, 1e-9);
  }
}

}  // namespace
