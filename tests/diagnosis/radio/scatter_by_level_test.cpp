// Scatter of single readings by level, of draws whose law is known.
#include "diagnosis/radio/laws/scatter_by_level.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/diagnosis/walk.hpp"

namespace muster::diagnosis {
namespace {

// Pairs at levels from -90 to -40 dBm; what is above `knee` is reported with a share of its scatter.
ScatterByLevel scatter(double knee, double share, int pairs = 600) {
  std::mt19937 random(3);
  std::normal_distribution<double> draw(0, 1.5);
  std::uniform_real_distribution<double> levels(-90, -40);
  CloseReadings close;
  close.pairs = pairs;
  close.apart.resize(pairs);
  Eigen::VectorXd level(2 * pairs);
  for (int k = 0; k < pairs; ++k) {
    const double at = levels(random), part = at > knee ? share : 1;
    level[2 * k] = level[2 * k + 1] = at;
    close.first.push_back(2 * k);
    close.apart[k] = part * std::abs(draw(random) - draw(random));
  }
  return scatter_by_level(close, level);
}

TEST(ScatterByLevel, IsToldWhereAReceiverCompresses) {
  const ScatterByLevel found = scatter(-60, 0.4);
  EXPECT_LT(found.log_p, std::log(1e-6));
  EXPECT_NEAR(found.weak, 1.5, 0.15);
  EXPECT_NEAR(found.strong, 0.6, 0.1);
}

TEST(ScatterByLevel, IsNotToldOfOneLaw) {
  const ScatterByLevel found = scatter(0, 1);
  EXPECT_GT(found.log_p, std::log(0.01));
  EXPECT_NEAR(found.weak, found.strong, 0.2);
}

// The world expects one level throughout; shadowing makes it vary. Half of what exceeds 2 dB is lost, fading included.
TEST(ScatterByLevel, IsToldByTheLevelThatTheFieldMakes) {
  Walk walk = drawn_of_four({.rician_k = 8}, 600, 6);
  const auto log_p = [&] {
    const KrigedReadings field(walk.readings, walk.residual);
    return scatter_by_level(field.close_readings(), Eigen::VectorXd::Zero(field.size())).log_p;
  };
  EXPECT_GT(log_p(), std::log(0.01));
  walk.residual = (walk.residual.array() > 2).select((walk.residual.array() + 2) / 2, walk.residual);
  EXPECT_LT(log_p(), std::log(1e-5));
}

// A robot that stops every half metre, where each direction is measured once: both are of one place, and no others are.
TEST(CloseReadings, ArePairsOfBothDirections) {
  constexpr int places = 200;
  LinkReadings r;
  r.tx_at = Eigen::Matrix3Xd::Zero(3, 2 * places);
  r.rx_at = Eigen::Matrix3Xd::Zero(3, 2 * places);
  std::mt19937 random(5);
  std::normal_distribution<double> draw(0, 1.5);
  Eigen::VectorXd residual(2 * places);
  for (int k = 0; k < places; ++k) {
    for (const int i : {2 * k, 2 * k + 1}) {
      (i % 2 == 0 ? r.rx_at : r.tx_at)(0, i) = 0.5 * k;
      r.tx.push_back(i % 2 == 0 ? 0 : 9);
      r.rx.push_back(i % 2 == 0 ? 9 : 0);
      r.t.push_back(k + 0.5 * (i % 2));
      residual[i] = draw(random);
    }
  }
  EXPECT_EQ(KrigedReadings(r, residual).close_readings().pairs, places);
}

TEST(ScatterByLevel, OfAFewPairsNothingIsTold) { EXPECT_EQ(scatter(-60, 0.4, 20).log_p, 0); }

}  // namespace
}  // namespace muster::diagnosis
