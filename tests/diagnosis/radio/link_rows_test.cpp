// Rows of link readings: their limits, distances and order, and the sites of both directions of a link.
#include "diagnosis/radio/links/link_rows.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "muster/random.hpp"
#include "tests/diagnosis/inference/apart.hpp"
#include "tests/diagnosis/inference/synthetic.hpp"

namespace muster::diagnosis {
namespace {

using noise::Index;
using noise::middles_apart;
using noise::readings_apart;
using noise::Rows;
using noise::Sites;

// For an exponential field on a line, the distance of two rows is half the variance of their difference. It is the
// mean distance of their readings less that within one, in decorrelation distances, as long as it is well below one.
TEST(LinkRows, DistanceIsThatOfTheMeansOnALine) {
  constexpr double pace = 0.1;  // m between readings
  for (const int each : {1, 2, 3, 4, 6, 9}) {
    LinkReadings r;
    const int size = 12 * each;
    r.tx_at = r.rx_at = Eigen::Matrix3Xd::Zero(3, size);
    r.tx_at.row(1).setConstant(5);
    for (int k = 0; k < size; ++k) {
      r.tx.push_back(0);
      r.rx.push_back(1);
      r.t.push_back(k);
      r.rx_at(0, k) = pace * k;
    }
    const Rows rows = link_rows(r, {.time = each - 0.5, .way = 100});
    ASSERT_EQ(rows.size(), 12) << each;
    const Sites sites = link_sites(rows, r);
    const auto mean_distance = [&](int from) {
      double sum = 0;
      for (int a = 0; a < each; ++a) {
        for (int b = 0; b < each; ++b) sum += std::abs(pace * (from + b - a)) / (each * each);
      }
      return sum;
    };
    for (const int away : {1, 2, 3, 6}) {
      const double truth = mean_distance(away * each) - mean_distance(0), h = pace * away * each;
      for (const int from : {0, 2, 5})
        EXPECT_NEAR(readings_apart(sites, from, from + away).place / truth, 1, 0.01) << each << ' ' << away;
      EXPECT_NEAR(middles_apart(sites, 0, away).place, h, 1e-9);
    }
    EXPECT_NEAR(sites.within(), mean_distance(0), 1e-9) << each;
  }
}

// Distances of rows that cross, run side by side or share a place are those of all their readings.
TEST(LinkRows, DistanceIsThatOfTheMeansInAnyDirection) {
  constexpr int each = 5;
  const std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> ways = {{{0, 0, 1}, {0.12, 0, 0}},
                                                                         {{0.24, -0.24, 1}, {0, 0.12, 0}},
                                                                         {{0, 0.1, 1}, {0.12, 0, 0}},
                                                                         {{1, 0.5, 1}, {-0.08, 0.09, 0}},
                                                                         {{0.3, 0, 1}, {0, 0, 0}}};
  LinkReadings r;
  r.tx_at = r.rx_at = Eigen::Matrix3Xd::Zero(3, each * 5);
  for (std::size_t way = 0; way < ways.size(); ++way) {
    for (int k = 0; k < each; ++k) {
      r.tx.push_back(0);
      r.rx.push_back(1);
      r.t.push_back(static_cast<double>(way) * 100 + k);
      r.rx_at.col(static_cast<Index>(r.t.size()) - 1) = ways[way].first + k * ways[way].second;
    }
  }
  const Rows rows = link_rows(r, {.time = 50, .way = 100});
  ASSERT_EQ(rows.size(), 5);
  const Sites sites = link_sites(rows, r);
  const auto mean_distance = [&](Index one, Index other) {
    double sum = 0;
    for (Index a = 0; a < each; ++a) {
      for (Index b = 0; b < each; ++b) sum += (r.rx_at.col(one * each + a) - r.rx_at.col(other * each + b)).norm();
    }
    return sum / (each * each);
  };
  for (Index one = 0; one < 5; ++one) {
    for (Index other = 0; other < one; ++other) {
      const double truth = mean_distance(one, other) - (mean_distance(one, one) + mean_distance(other, other)) / 2;
      EXPECT_NEAR(readings_apart(sites, one, other).place, truth, 0.015) << one << ' ' << other;
      EXPECT_EQ(readings_apart(sites, one, other).place, readings_apart(sites, one, other).both);
    }
  }
}

TEST(LinkRows, EndWhereAWallChangesTheLevel) {
  LinkReadings r;  // ten readings within a second and a quarter of a metre
  for (int k = 0; k < 10; ++k) {
    r.tx.push_back(0);
    r.rx.push_back(1);
    r.t.push_back(0.1 * k);
    r.level.push_back(k < 4 ? -50 - 0.1 * k : -54.0);
  }
  r.tx_at = Eigen::Matrix3Xd::Zero(3, 10);
  r.rx_at = Eigen::Matrix3Xd::Zero(3, 10);
  for (Index k = 0; k < 10; ++k) r.rx_at(0, k) = 5 + 0.025 * static_cast<double>(k);
  const Rows rows = link_rows(r);
  ASSERT_EQ(rows.size(), 2);
  EXPECT_EQ(rows.count()[0], 4);
  r.level.clear();
  EXPECT_EQ(link_rows(r).size(), 1);
}

// A radio that switches through two powers: readings of either are averaged, not of both, with a clock and without.
TEST(LinkRows, HoldReadingsOfOneSetting) {
  LinkReadings r;
  for (int k = 0; k < 12; ++k) {
    r.tx.push_back(0);
    r.rx.push_back(1);
    r.setting.push_back(k % 2);
  }
  r.tx_at = Eigen::Matrix3Xd::Zero(3, 12);
  r.rx_at = Eigen::Matrix3Xd::Ones(3, 12);
  for (const bool clock : {false, true}) {
    for (int k = 0; clock && k < 12; ++k) r.t.push_back(100 + 0.05 * k);
    const Rows rows = link_rows(r);
    ASSERT_EQ(rows.size(), 2) << clock;
    EXPECT_EQ(rows.count()[0], 6);
    for (Index i = 0; i < 12; ++i) EXPECT_EQ(rows.row_of()[static_cast<std::size_t>(i)], i % 2);
    EXPECT_EQ(middles(rows, r).setting, (std::vector<int>{0, 1}));
  }
  r.setting.clear();
  EXPECT_EQ(link_rows(r).size(), 1);
}

TEST(LinkRows, EndWhereEitherRadioTurns) {
  LinkReadings still;  // ten readings within a second at one place
  for (int k = 0; k < 10; ++k) {
    still.tx.push_back(0);
    still.rx.push_back(1);
    still.t.push_back(0.1 * k);
  }
  still.tx_at = Eigen::Matrix3Xd::Zero(3, 10);
  still.rx_at = Eigen::Matrix3Xd::Ones(3, 10);
  std::vector<double> turns(10, 3.1);
  for (std::size_t k = 5; k < 10; ++k) turns[k] = -3.1;  // past half a turn: 0.08 rad
  EXPECT_EQ(link_rows(still).size(), 1);
  for (std::vector<double> LinkReadings::*yaw : {&LinkReadings::tx_yaw, &LinkReadings::rx_yaw}) {
    LinkReadings turning = still;
    turning.*yaw = turns;
    EXPECT_EQ(link_rows(turning).size(), 1);
    (turning.*yaw)[7] = (turning.*yaw)[8] = (turning.*yaw)[9] = -2.2;
    const Rows rows = link_rows(turning);
    ASSERT_EQ(rows.size(), 2);
    EXPECT_EQ(rows.count()[0], 7);
    EXPECT_EQ(middles(rows, turning).*yaw, (std::vector<double>{3.1, -2.2}));
  }
}

TEST(LinkRowLimits, AreAsShortAsTheNumberOfRowsAllows) {
  for (const Index readings : {3000, 12000, 60000, 400000}) {
    LinkReadings r;  // of one link, 20 a second, at 0.5 m/s
    r.tx.assign(static_cast<std::size_t>(readings), 0);
    r.rx.assign(static_cast<std::size_t>(readings), 1);
    r.tx_at = r.rx_at = Eigen::Matrix3Xd::Zero(3, readings);
    for (Index k = 0; k < readings; ++k) {
      r.t.push_back(0.05 * static_cast<double>(k));
      r.rx_at(0, k) = 5 + 0.025 * static_cast<double>(k);
    }
    const LinkRowLimits limits = limits_for(r), usual;
    const Index rows = link_rows(r, limits).size();
    if (readings == 3000) {
      EXPECT_EQ(rows, readings);  // each is a row
    } else if (readings == 12000) {
      EXPECT_LT(limits.time, usual.time);
      EXPECT_LE(rows, 4000);
    } else {
      EXPECT_LE(rows, 10000);
      EXPECT_EQ(limits.way > usual.way, readings == 400000);
    }
    EXPECT_EQ(limits.way / usual.way, limits.time / usual.time);
  }
}

// Twenty readings of each place, of which nobody knows when they were made: their scatter would be gone in one row.
TEST(LinkRowLimits, KeepReadingsWithoutATimeApart) {
  for (const Index places : {30, 1000}) {
    LinkReadings r;
    const Index readings = 20 * places;
    r.tx.assign(static_cast<std::size_t>(readings), 0);
    r.rx.assign(static_cast<std::size_t>(readings), 1);
    r.tx_at = r.rx_at = Eigen::Matrix3Xd::Zero(3, readings);
    for (Index k = 0; k < readings; ++k) {
      const Index place = k / 20;
      r.rx_at(0, k) = 5 + 10 * static_cast<double>(place);
    }
    // Of 20,000 readings rows of 8, 8 and 4: rows of 4 would be more than 4,000.
    EXPECT_EQ(link_rows(r, limits_for(r)).size(), places == 30 ? readings : 3 * places) << places;
  }
}

TEST(LinkSites, AreTheSameForBothDirectionsOfALink) {
  LinkReadings two_ways;  // radio 1 stands, radio 0 moves; each reading is followed by its return
  for (int k = 0; k < 20; ++k) {
    two_ways.tx.insert(two_ways.tx.end(), {1, 0});
    two_ways.rx.insert(two_ways.rx.end(), {0, 1});
    two_ways.t.insert(two_ways.t.end(), {0.5 * k, 0.5 * k});
  }
  two_ways.tx_at = Eigen::Matrix3Xd::Zero(3, 40);
  two_ways.rx_at = Eigen::Matrix3Xd::Zero(3, 40);
  for (Index k = 0; k < 20; ++k)
    two_ways.rx_at(0, 2 * k) = two_ways.tx_at(0, 2 * k + 1) = 5 + 0.2 * static_cast<double>(k);
  const Sites sites = link_sites(link_rows(two_ways), two_ways);
  ASSERT_EQ(sites.size() % 2, 0);
  const Index half = sites.size() / 2;
  for (Index i = 0; i < half; ++i) {
    EXPECT_EQ(sites.group[static_cast<std::size_t>(i)], 1);
    EXPECT_EQ(sites.group[static_cast<std::size_t>(half + i)], 1);
    EXPECT_TRUE(sites.place.col(i).isApprox(sites.place.col(half + i)));
    EXPECT_GT(sites.place(0, i), 4);
  }
}

TEST(LinkRows, AreIndependentOfTheOrderOfReadings) {
  const auto world = synthetic::world_of(synthetic::varied(2, 1500));
  std::vector<Index> order(1500);
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [](Index a, Index b) {
    return Stream(1).uniform(static_cast<uint64_t>(a)) < Stream(1).uniform(static_cast<uint64_t>(b));
  });
  LinkReadings mixed = world.readings;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto from = static_cast<std::size_t>(order[i]);
    mixed.t[i] = world.readings.t[from];
    mixed.tx[i] = world.readings.tx[from];
    mixed.rx[i] = world.readings.rx[from];
    mixed.rx_yaw[i] = world.readings.rx_yaw[from];
  }
  mixed.tx_at = world.readings.tx_at(Eigen::all, order).eval();
  mixed.rx_at = world.readings.rx_at(Eigen::all, order).eval();
  const Rows a = link_rows(world.readings), b = link_rows(mixed);
  ASSERT_EQ(a.size(), b.size());
  EXPECT_EQ(a.mean(world.rssi), b.mean(world.rssi(order)));
  EXPECT_EQ(link_sites(a, world.readings).place, link_sites(b, mixed).place);
  EXPECT_LT(a.count().maxCoeff(), 5);  // 0.4 s between readings, 1.2 s a row
  EXPECT_EQ(a.count().sum(), 1500);
}

TEST(RadiosOfRows, AreStationsOrRobotsWhereThereIsOneStation) {
  const auto world = synthetic::world_of(synthetic::varied(15, 3000));
  const noise::Rows rows = link_rows(world.readings);
  const noise::Sites sites = link_sites(rows, world.readings);
  const std::vector<int> radios = radios_of(rows, sites, world.readings);
  const std::set<int> different(radios.begin(), radios.end());
  ASSERT_GE(different.size(), 2u);
  EXPECT_EQ(*different.rbegin() + 1, static_cast<int>(different.size()));
  // With one stationary radio, the moving ones are left out in turn.
  LinkReadings one = world.readings;
  const int robot = *std::max_element(one.rx.begin(), one.rx.end()) + 1;
  for (std::size_t i = 0; i < one.tx.size(); ++i) {
    one.rx[i] = robot + one.tx[i];
    one.tx[i] = 0;
    one.tx_at.col(static_cast<Index>(i)) = one.tx_at.col(0);
  }
  const noise::Rows of_one = link_rows(one);
  const std::vector<int> robots = radios_of(of_one, link_sites(of_one, one), one);
  for (Index i = 0; i < of_one.size(); ++i) {
    const auto example = static_cast<std::size_t>(of_one.example(i));
    EXPECT_EQ(robots[static_cast<std::size_t>(i)] == robots[0],
              one.rx[example] == one.rx[static_cast<std::size_t>(of_one.example(0))]);
  }
}

// Bursts at two places, one of them twice. What is asked every hour is one long stay.
TEST(Stays, EndAtAPause) {
  LinkReadings r;
  std::vector<std::pair<double, double>> visits;  // time and place
  for (const auto& [from, place] : {std::pair(0.0, 3.0), {100.0, 3.0}, {200.0, 5.0}})
    for (int k = 0; k < 20; ++k) visits.emplace_back(from + 0.5 * k, place);
  const auto stays_of = [&] {
    r = {};
    const auto size = static_cast<Index>(visits.size());
    r.tx_at = r.rx_at = Eigen::Matrix3Xd::Zero(3, size);
    for (Index i = 0; i < size; ++i) {
      const auto& [t, place] = visits[static_cast<std::size_t>(i)];
      r.tx.push_back(0);
      r.rx.push_back(1);
      r.t.push_back(t);
      r.rx_at(0, i) = place;
    }
    const LinkLayout layout(r, {.time = 0, .way = -1});
    const std::vector<int> stays = layout.stays(layout.rows());
    return std::set(stays.begin(), stays.end()).size();
  };
  EXPECT_EQ(stays_of(), 3u);
  for (std::size_t k = 0; k < visits.size(); ++k) visits[k] = {3600.0 * static_cast<double>(k), 3};
  EXPECT_EQ(stays_of(), 1u);
  // Several readings a second, by a clock of whole seconds.
  for (std::size_t k = 0; k < visits.size(); ++k) visits[k] = {std::floor(static_cast<double>(k) / 8), 3};
  EXPECT_EQ(stays_of(), 1u);
}

// Of readings on the way several are a row, of one place none: they are in no stay. Both ways of a link at one moment
// are in one, and their differences in none.
TEST(Stays, AreNotOnTheWay) {
  constexpr Index size = 240, standing_until = size / 2;
  LinkReadings r;
  r.tx_at = r.rx_at = Eigen::Matrix3Xd::Zero(3, size);
  for (Index i = 0; i < size; ++i) {
    const bool second = i % 2 == 1;
    const Index moment = i / 2, driven = std::max<Index>(0, i - standing_until);
    r.tx.push_back(second ? 1 : 0);
    r.rx.push_back(second ? 0 : 1);
    r.t.push_back(0.05 * static_cast<double>(moment));
    r.twin.push_back(second ? i - 1 : i + 1);
    (second ? r.tx_at : r.rx_at)(0, i) = 3 + 0.1 * static_cast<double>(driven);
  }
  const LinkLayout layout(r, {});
  const noise::Rows rows = layout.rows();
  const std::vector<int> stays = layout.stays(rows);
  ASSERT_GT(rows.size(), rows.means());
  double standing = 0;
  for (Index row = 0; row < rows.size(); ++row) {
    const int stay = stays[static_cast<std::size_t>(row)];
    EXPECT_TRUE(stay == 0 || stay == -1) << stay;
    if (stay == 0) standing += rows.count()[row];
    EXPECT_EQ(stay, row < rows.means() && rows.last(row) < standing_until ? 0 : -1) << row;
  }
  EXPECT_GT(standing, 5);
}

}  // namespace
}  // namespace muster::diagnosis
