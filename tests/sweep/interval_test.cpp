// Intervals against closed forms of Student's t and numbers worked out by hand.
#include "sweep/interval.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace muster::sweep {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

TEST(Interval, QuantilesHaveTheirClosedForms) {
  for (const double p : {0.6, 0.9, 0.975, 0.995}) {
    const double a = 4 * p * (1 - p), q = std::cos(std::acos(std::sqrt(a)) / 3) / std::sqrt(a);
    EXPECT_NEAR(t_quantile(p, 1), std::tan(std::numbers::pi * (p - 0.5)), 1e-9) << p;
    EXPECT_NEAR(t_quantile(p, 2), (2 * p - 1) * std::sqrt(2 / a), 1e-12) << p;
    EXPECT_NEAR(t_quantile(p, 4), 2 * std::sqrt(q - 1), 1e-12) << p;
  }
  EXPECT_NEAR(t_quantile(0.975, 19), 2.093, 5e-4);  // as tables print it
  EXPECT_NEAR(t_quantile(0.975, 1e9), 1.959964, 1e-6);
}

TEST(Interval, OfAFewNumbers) {
  const Interval found = interval_of({1, 2, 3, 4, 10});
  EXPECT_EQ(found.count, 5u);
  EXPECT_DOUBLE_EQ(found.mean, 4);
  EXPECT_DOUBLE_EQ(found.deviation, std::sqrt(50.0 / 4));
  const double half = 2.7764451052 * std::sqrt(12.5 / 5);  // t of 4 degrees at 97.5 %
  EXPECT_NEAR(found.low, 4 - half, 1e-9);
  EXPECT_NEAR(found.high, 4 + half, 1e-9);
}

TEST(Interval, OfTooFew) {
  EXPECT_TRUE(std::isnan(interval_of({}).mean));
  EXPECT_EQ(interval_of({none}).count, 0u);
  const Interval one = interval_of({none, 7});
  EXPECT_EQ(one.count, 1u);
  EXPECT_EQ(one.mean, 7);
  EXPECT_TRUE(std::isnan(one.low) && std::isnan(one.high) && std::isnan(one.deviation));
}

TEST(Interval, PairsAreTakenSeedBySeed) {
  // Differences 1, 2, 1; the fourth pair lacks one.
  const Interval found = paired_interval({11, 52, 91, 3}, {10, 50, 90, none});
  EXPECT_EQ(found.count, 3u);
  EXPECT_DOUBLE_EQ(found.mean, 4.0 / 3);
  const double half = 4.3026527297 * std::sqrt(1.0 / 3) / std::sqrt(3.0);  // t of 2 degrees
  EXPECT_NEAR(found.low, 4.0 / 3 - half, 1e-9);
  EXPECT_NEAR(found.high, 4.0 / 3 + half, 1e-9);
  // What is the same in both of a pair is no part of the difference, however much it varies.
  const Interval shifted = paired_interval({1e3 + 2, -1e3 + 2, 2}, {1e3, -1e3, 0});
  EXPECT_EQ(shifted.mean, 2);
  EXPECT_EQ(shifted.low, 2);
  EXPECT_EQ(shifted.high, 2);
}

// Of 4,000 samples from a law of mean 0, as many intervals hold the 0 as they should.
TEST(Interval, CoversTheMeanAsOftenAsItSays) {
  std::mt19937_64 draw(1);
  std::normal_distribution<double> law(0, 3);
  int held = 0;
  constexpr int samples = 4000;
  for (int i = 0; i < samples; ++i) {
    std::vector<double> values(5);
    for (double& value : values) value = law(draw);
    const Interval found = interval_of(values);
    held += found.low < 0 && found.high > 0;
  }
  const double deviation = std::sqrt(coverage * (1 - coverage) / samples);
  EXPECT_NEAR(static_cast<double>(held) / samples, coverage, 4 * deviation);
}

}  // namespace
}  // namespace muster::sweep
