// The chain of crossings, on simulated chains.
#include "diagnosis/radio/laws/likely_blocked.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "muster/random.hpp"

namespace muster::diagnosis {
namespace {

constexpr Crossings crossings{7, 0.1, 4};
constexpr int readings = 2000;
constexpr double apart = 0.5;  // s

struct Chain {
  std::vector<double> time;
  std::vector<bool> blocked;
  Eigen::VectorXd level;
};

// A chain of these crossings, with normal noise of 1.2 dB; `jump`: dB from its middle on.
Chain chain(uint64_t seed, double jump) {
  const Stream random(combined(key_of("chain"), seed));
  Chain result{{}, {}, Eigen::VectorXd(readings)};
  const double leave = -std::expm1(-apart / crossings.duration), come = leave * crossings.share / (1 - crossings.share);
  bool blocked = false;
  for (int i = 0; i < readings; ++i) {
    const auto k = static_cast<uint64_t>(i);
    if (random.of(1).uniform(k) < (blocked ? leave : come)) blocked = !blocked;
    result.time.push_back(apart * i);
    result.blocked.push_back(blocked);
    result.level[i] = 1.2 * random.of(2).normal(k) - (blocked ? crossings.loss : 0) + (i > readings / 2 ? jump : 0);
  }
  return result;
}

// Of a hundred readings said to be blocked at 0.9 some ninety are: calibrated, and nearly all blocked ones are found.
TEST(LikelyBlocked, FindsTheReadingsThatWereBlocked) {
  double said = 0, right = 0, found = 0, all = 0;
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    const Chain c = chain(seed, 0);
    const std::vector<double> p = probability_blocked(c.time, c.level, crossings);
    ASSERT_EQ(p.size(), c.time.size());
    for (std::size_t i = 0; i < p.size(); ++i) {
      said += p[i];
      right += c.blocked[i];
      all += c.blocked[i];
      found += c.blocked[i] && p[i] >= 0.3;
    }
  }
  EXPECT_NEAR(said / right, 1, 0.06);
  EXPECT_GT(found / all, 0.97);
}

TEST(LikelyBlocked, ALastingChangeOfLevelIsNoCrossing) {
  Chain c = chain(3, 0);
  for (std::size_t i = 0; i < c.blocked.size(); ++i)
    if (c.blocked[i]) c.level[static_cast<Eigen::Index>(i)] += crossings.loss;  // nobody crosses
  c.level.tail(readings / 2).array() -= crossings.loss;
  int said = 0;
  for (const double p : probability_blocked(c.time, c.level, crossings)) said += p >= 0.3;
  EXPECT_LE(said, 70);  // within a median of the step
}

TEST(LikelyBlocked, NoReadingsAreNoCrossings) { EXPECT_TRUE(probability_blocked({}, {}, crossings).empty()); }

}  // namespace
}  // namespace muster::diagnosis
