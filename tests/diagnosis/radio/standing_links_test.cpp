// People who walk about in a standing network, on simulated levels; and what resembles them.
#include "diagnosis/radio/laws/standing_links_test.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "muster/random.hpp"

namespace muster::diagnosis {
namespace {

constexpr int nodes = 6, rounds = 120;
constexpr double round_time = 0.6;  // s

// Every node to every other, once a round.
LinkReadings network() {
  LinkReadings r;
  const int links = nodes * (nodes - 1);
  r.tx_at.resize(3, rounds * links);
  r.rx_at.resize(3, rounds * links);
  for (int k = 0; k < rounds; ++k) {
    for (int tx = 0; tx < nodes; ++tx) {
      for (int rx = 0; rx < nodes; ++rx) {
        if (tx == rx) continue;
        const Eigen::Index i = r.size();
        r.tx_at.col(i) << 3 * tx, tx % 2, 1;
        r.rx_at.col(i) << 3 * rx, rx % 2, 1;
        r.t.push_back(k * round_time + 0.05 * tx);
        r.tx.push_back(tx);
        r.rx.push_back(rx);
      }
    }
  }
  return r;
}

// `of` gives what each reading is off, beside normal noise of 1 dB.
template <class Off>
Eigen::VectorXd levels(const LinkReadings& r, uint64_t seed, const Off& of) {
  Eigen::VectorXd result(r.size());
  const Stream random(combined(key_of("walkers"), seed));
  for (Eigen::Index i = 0; i < r.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    result[i] = random.of(1).normal(k) + of(r.t[k], r.tx[k], r.rx[k], random.of(2), k);
  }
  return result;
}

uint64_t pair(int a, int b) {
  const auto [low, high] = std::minmax({a, b});
  return uint64_t{nodes} * static_cast<uint64_t>(low) + static_cast<uint64_t>(high);
}

// As plugin effect.people draws them: windows of 2 s, of which a share is blocked, both ways alike.
Eigen::VectorXd crossed(const LinkReadings& r, uint64_t seed, double loss, double share) {
  return levels(r, seed, [&](double t, int tx, int rx, const Stream& random, std::size_t) {
    return random.of(pair(tx, rx)).uniform(static_cast<uint64_t>(t / 2)) < share ? -loss : 0;
  });
}

bool told(const WalkersTest& walkers) { return walkers.test.log_p < std::log(1e-4); }

TEST(WalkersTest, FindsLossShareAndDurationOfCrossings) {
  const LinkReadings r = network();
  int covered = 0;
  for (uint64_t seed = 0; seed < 10; ++seed) {
    const WalkersTest walkers = walkers_test(r, crossed(r, seed, 6, 0.15));
    ASSERT_TRUE(told(walkers)) << seed;
    EXPECT_EQ(walkers.links, nodes * (nodes - 1));
    ASSERT_EQ(walkers.test.values.size(), 3);
    const auto& [loss, share, duration] =
        std::tie(walkers.test.values[0], walkers.test.values[1], walkers.test.values[2]);
    EXPECT_NEAR(loss.value, 6, 1.2) << seed;
    EXPECT_NEAR(share.value, 0.15, 0.06) << seed;
    EXPECT_NEAR(duration.value, 2, 0.6) << seed;
    covered += loss.lower95 <= 6 && 6 <= loss.upper95;
  }
  EXPECT_GE(covered, 8);
}

// A tenth of the readings is off by up to 15 dB, one by one.
TEST(WalkersTest, ReadingsThatAreOffOneByOneAreNoWalker) {
  const LinkReadings r = network();
  for (uint64_t seed = 0; seed < 20; ++seed) {
    const auto outliers = [](double, int, int, const Stream& random, std::size_t k) {
      return random.uniform(k, 1) < 0.1 ? 15 * (2 * random.uniform(k, 2) - 1) : 0;
    };
    EXPECT_FALSE(told(walkers_test(r, levels(r, seed, outliers)))) << seed;
  }
}

// A transmitter that swings, and a receiver whose gain is switched every few seconds.
TEST(WalkersTest, WhatARadioSharesIsNoWalker) {
  const LinkReadings r = network();
  for (uint64_t seed = 0; seed < 10; ++seed) {
    const auto swings = [](double t, int tx, int rx, const Stream&, std::size_t) {
      return (tx == 1 ? 4 * std::sin(2 * M_PI * t / 7) : 0) + (rx == 2 && std::fmod(t, 9) < 3 ? -5 : 0);
    };
    EXPECT_FALSE(told(walkers_test(r, levels(r, seed, swings)))) << seed;
  }
}

// Each link drifts its own way, by as much as a crossing takes.
TEST(WalkersTest, SlowChangesAreNoWalker) {
  const LinkReadings r = network();
  for (uint64_t seed = 0; seed < 10; ++seed) {
    const auto drifts = [](double t, int tx, int rx, const Stream& random, std::size_t) {
      const Stream link = random.of(pair(tx, rx));
      return 3 * std::sin(2 * M_PI * (t / 300 + link.uniform(0)));
    };
    EXPECT_FALSE(told(walkers_test(r, levels(r, seed, drifts)))) << seed;
  }
}

// A door beside one link, shut for twenty seconds now and then.
TEST(WalkersTest, ADoorBesideOneLinkIsNoWalker) {
  const LinkReadings r = network();
  for (uint64_t seed = 0; seed < 10; ++seed) {
    const auto door = [](double t, int tx, int rx, const Stream&, std::size_t) {
      return std::min(tx, rx) == 0 && std::max(tx, rx) == 4 && std::fmod(t, 40) > 20 ? -8 : 0;
    };
    EXPECT_FALSE(told(walkers_test(r, levels(r, seed, door)))) << seed;
  }
}

// Both directions at one time with one scatter, as the two halves of an exchange of messages are.
TEST(WalkersTest, TwinsCountOnceAndTellBothWhatTheirRadiosShare) {
  LinkReadings r = network();
  constexpr Eigen::Index in_round = nodes * (nodes - 1);
  for (Eigen::Index i = 0; i < r.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    const int tx = r.tx[k], rx = r.rx[k];
    r.twin.push_back(i / in_round * in_round + rx * (nodes - 1) + (tx < rx ? tx : tx - 1));
    r.t[k] -= 0.05 * tx;
  }
  const auto halves = [&](Eigen::VectorXd off) {
    for (Eigen::Index i = 0; i < r.size(); ++i) {
      const Eigen::Index other = r.twin[static_cast<std::size_t>(i)];
      if (other < i) off[i] = off[other];
    }
    return off;
  };
  int named = 0;
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    const WalkersTest walkers = walkers_test(r, halves(crossed(r, seed, 6, 0.15)));
    EXPECT_EQ(walkers.links, nodes * (nodes - 1) / 2);
    EXPECT_TRUE(told(walkers)) << seed;
    named += told(walkers_test(r, halves(crossed(r, seed, 0, 0))));
  }
  EXPECT_EQ(named, 0);
}

TEST(WalkersTest, LinksOfAWalkTakeNoPart) {
  LinkReadings r = network();
  for (Eigen::Index i = 0; i < r.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (r.tx[k] == 0) r.tx_at(0, i) += r.t[k] / 10;
    if (r.rx[k] == 0) r.rx_at(0, i) += r.t[k] / 10;
  }
  EXPECT_EQ(walkers_test(r, crossed(r, 1, 6, 0.15)).links, (nodes - 1) * (nodes - 2));
  r.t.clear();
  EXPECT_EQ(walkers_test(r, Eigen::VectorXd::Zero(r.size())).links, 0);
}

}  // namespace
}  // namespace muster::diagnosis
