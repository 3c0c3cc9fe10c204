// Tables that keep only what was heard: how surely they end at a floor, by the distribution of what says so.
#include "diagnosis/calibration/truncation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

namespace muster::diagnosis {
namespace {

using Kept = std::function<bool(double level)>;

struct Log {
  Eigen::VectorXd heard, mean;
};

// Levels of 2 dB scatter about means that fall from -40 to -80 dBm; `off`, dB: what the means miss of the weakest.
Log log_of(unsigned seed, const Kept& kept, double off = 0) {
  std::mt19937 random(seed);
  std::normal_distribution<double> error(0, 2);
  std::vector<double> heard, mean;
  for (int i = 0; i < 1000; ++i) {
    const double expected = -40 - 0.04 * i, level = expected + error(random);
    if (!kept(level)) continue;
    heard.push_back(level);
    mean.push_back(expected < -70 ? expected - off : expected);
  }
  const auto as_vector = [](const std::vector<double>& v) -> Eigen::VectorXd {
    return Eigen::Map<const Eigen::VectorXd>(v.data(), static_cast<Eigen::Index>(v.size()));
  };
  return {as_vector(heard), as_vector(mean)};
}

Truncation end_of(const Log& log) {
  return truncation_of(log.heard, log.mean, Eigen::VectorXd::Constant(log.heard.size(), 2), 0);
}

bool all(double) { return true; }

// Kolmogorov's distance, of 1 % at 300 draws.
TEST(Truncation, IsExponentialWithoutAFloor) {
  std::vector<double> evidence;
  for (unsigned seed = 0; seed < 300; ++seed) evidence.push_back(end_of(log_of(seed, all)).evidence);
  std::sort(evidence.begin(), evidence.end());
  double away = 0;
  for (std::size_t k = 0; k < evidence.size(); ++k)
    away = std::max(away, std::abs(1 - std::exp(-evidence[k]) - (static_cast<double>(k) + 0.5) / 300));
  EXPECT_LT(away, 1.63 / std::sqrt(300));
}

TEST(Truncation, OfAFloorIsBeyondDoubtAndAbrupt) {
  const Truncation end = end_of(log_of(1, [](double level) { return level >= -72; }));
  EXPECT_NEAR(end.floor, -72, 0.2);
  EXPECT_GT(end.evidence, 30);
  EXPECT_TRUE(end.is_abrupt());
}

// Means that are too low leave as much room below all readings, and few close to its end.
TEST(Truncation, OfMeansThatAreTooLowIsNotAbrupt) {
  const Truncation end = end_of(log_of(1, all, 12));
  EXPECT_GT(end.evidence, 30);
  EXPECT_FALSE(end.is_abrupt());
}

}  // namespace
}  // namespace muster::diagnosis
