// What one station leaves open, and where a second one would tell.
#include "diagnosis/planning/second_station.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace muster::diagnosis {
namespace {

using Eigen::Index;
using Eigen::Vector2d;
using Eigen::VectorXd;

enum Radio { base, mast, rover };

// The rover drives along y = 6 from x = -8 to 8; the base stands at the origin, the mast at (10, 0). Rows of the base
// first, then as many of the mast.
RowSummary driven() {
  RowSummary seen;
  seen.radios = {"base", "mast", "rover"};
  constexpr Index places = 33;
  seen.tx_at.resize(3, 2 * places);
  seen.rx_at.resize(3, 2 * places);
  for (Index i = 0; i < 2 * places; ++i) {
    seen.tx.push_back(i < places ? base : mast);
    seen.rx.push_back(rover);
    seen.tx_at.col(i) = i < places ? Eigen::Vector3d(0, 0, 1) : Eigen::Vector3d(10, 0, 1);
    seen.rx_at.col(i) << -8 + 0.5 * static_cast<double>(i % places), 6, 0.4;
  }
  return seen;
}

// Straight above the base, from 1 to 5 m off.
std::vector<Vector2d> up_the_line() {
  std::vector<Vector2d> places;
  for (int k = 0; k <= 40; ++k) places.emplace_back(0, 1 + 0.1 * k);
  return places;
}

VectorXd shadow(const RowSummary& seen, bool of_the_mast_too) {
  VectorXd effect = VectorXd::Zero(seen.tx_at.cols());
  for (Index i = 0; i < effect.size(); ++i) {
    const bool behind = std::abs(seen.rx_at(0, i)) < 1.1;
    if (behind && (seen.tx[static_cast<std::size_t>(i)] == base || of_the_mast_too)) effect[i] = -7;
  }
  return effect;
}

TEST(SecondStation, ARangeAndAPlaceToTheSideAreTold) {
  const RowSummary seen = driven();
  const auto open = seen_from_one_station(seen, shadow(seen, false), up_the_line());
  ASSERT_TRUE(open);
  EXPECT_EQ(open->radio, "base");
  EXPECT_NEAR(open->nearest, 1.1, 0.11);
  EXPECT_NEAR(open->farthest, 4.9, 0.11);
  // From (x, 6) the range from (0, 1.1) to (0, 4.9) is widest at |x| = sqrt(1.1 * 4.9), two metres and more away.
  ASSERT_TRUE(open->second);
  EXPECT_NEAR(std::abs(open->second->x()), std::sqrt(1.1 * 4.9), 0.5);
  EXPECT_DOUBLE_EQ(open->second->y(), 6);
}

TEST(SecondStation, NothingIsOpenIfASecondOneSeesIt) {
  const RowSummary seen = driven();
  EXPECT_FALSE(seen_from_one_station(seen, shadow(seen, true), up_the_line()));
}

TEST(SecondStation, NothingIsOpenIfTheDistanceIsKnown) {
  const RowSummary seen = driven();
  const std::vector<Vector2d> places{{0, 3}, {0.1, 3.2}, {-0.1, 3.1}};
  EXPECT_FALSE(seen_from_one_station(seen, shadow(seen, false), places));
}

TEST(SecondStation, NothingIsSaidWithoutAPlace) {
  const RowSummary seen = driven();
  EXPECT_FALSE(seen_from_one_station(seen, shadow(seen, false), {}));
  EXPECT_FALSE(seen_from_one_station(seen, VectorXd::Zero(seen.tx_at.cols()), up_the_line()));
}

}  // namespace
}  // namespace muster::diagnosis
