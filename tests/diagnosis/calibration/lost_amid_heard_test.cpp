// Readings that were lost for another reason than a receiver's floor.
#include "diagnosis/calibration/lost_amid_heard.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace muster::diagnosis {
namespace {

// A robot drives 40 m away from a station, a reading a metre: from -60 to -99 dBm, and the receiver's floor is -90.
struct Drive {
  Readings readings{.rssi = Eigen::VectorXd::LinSpaced(40, -60, -99), .floor = -90};
  std::vector<LinkPlace> links;
  Eigen::VectorXd mean = readings.rssi;

  explicit Drive(double apart = 0.25) {
    for (int i = 0; i < 40; ++i) links.push_back({{0, 0, 1}, {1 + apart * i, 0, 1}, 0, 1});
    readings.rssi = (readings.rssi.array() < readings.floor).select(std::nan(""), readings.rssi);
  }
  void lose(std::initializer_list<Eigen::Index> rows) {
    for (const Eigen::Index row : rows) readings.rssi[row] = std::nan("");
  }
  std::vector<Eigen::Index> otherwise() const { return lost_amid_heard(readings, links, {}, mean, 3); }
};

TEST(LostAmidHeard, IsNoBound) {
  Drive drive;
  EXPECT_TRUE(drive.otherwise().empty());
  drive.lose({0, 4, 12});
  EXPECT_EQ(drive.otherwise(), (std::vector<Eigen::Index>{0, 4, 12}));
}

TEST(LostAmidHeard, NearTheFloorIsABound) {
  Drive drive;
  drive.lose({26});  // at -86 dBm
  EXPECT_TRUE(drive.otherwise().empty());
}

// Behind a wall that the world does not know the level is below the floor, and all readings are lost there.
TEST(LostAmidHeard, ManyBesideEachOtherAreBounds) {
  Drive drive;
  drive.lose({8, 9, 10, 11, 12});
  EXPECT_TRUE(drive.otherwise().empty());
}

// The level there is what the neighbours say, not what the model expects.
TEST(LostAmidHeard, BesideWeakReadingsIsABound) {
  Drive drive;
  drive.readings.rssi.segment(2, 12).array() -= 24;
  drive.lose({8});
  EXPECT_TRUE(drive.otherwise().empty());
}

TEST(LostAmidHeard, FarFromOthersMayHaveAShadowOfItsOwn) {
  Drive drive(3);
  drive.lose({8});
  EXPECT_TRUE(drive.otherwise().empty());
}

// Of readings of a link that stands those next to it in the log count; another link's do not.
TEST(LostAmidHeard, IsAskedOfItsOwnLink) {
  Drive drive(0);
  drive.lose({4});
  EXPECT_EQ(drive.otherwise().size(), 1u);
  for (std::size_t i = 0; i < drive.links.size(); i += 2) drive.links[i].radio_a = 2;
  drive.readings.rssi.setConstant(-60);
  for (Eigen::Index i = 0; i < 40; i += 2) drive.readings.rssi[i] = std::nan("");
  EXPECT_TRUE(drive.otherwise().empty());
}

// Two stations in turn; `t`: that of the second one comes after all of the first.
struct Two {
  Readings readings{.rssi = Eigen::VectorXd::Constant(80, -70), .floor = -90};
  std::vector<LinkPlace> links;
  std::vector<double> t;
  Eigen::VectorXd mean = readings.rssi;

  explicit Two(bool by_station = false) {
    for (int i = 0; i < 80; ++i) {
      const int station = by_station ? i / 40 : i % 2, moment = by_station ? i % 40 : i / 2;
      links.push_back({{1.0 * station, 0, 1}, {2 + 0.3 * moment, 0, 1}, station, 2});
      t.push_back(0.5 * moment);
      if (moment >= 10 && moment < 20) readings.rssi[i] = std::nan("");
    }
  }
  std::size_t otherwise() const { return lost_amid_heard(readings, links, t, mean, 3).size(); }
};

TEST(LostAmidHeard, SilencesOfAllLinksAreNoBounds) {
  EXPECT_EQ(Two().otherwise(), 20u);
  EXPECT_EQ(Two(true).otherwise(), 20u);  // by their times
  Two at_first;
  at_first.readings.rssi.head(20).setConstant(std::nan(""));
  EXPECT_EQ(at_first.otherwise(), 40u);
  Two weak;  // one of both is near the floor
  for (Eigen::Index i = 1; i < 80; i += 2) weak.readings.rssi[i] -= 15;
  weak.mean = weak.readings.rssi.array().isNaN().select(-85, weak.readings.rssi);
  weak.mean(Eigen::seq(0, 79, 2)).setConstant(-70);
  EXPECT_EQ(weak.otherwise(), 0u);
  Two without_times;
  without_times.t.clear();
  EXPECT_EQ(without_times.otherwise(), 0u);
  Two passed;  // three of a scan of ten, in whose way something stands
  for (std::size_t i = 0; i < passed.links.size(); ++i) passed.links[i].radio_a = static_cast<int>(10 + i % 10);
  passed.readings.rssi.setConstant(-70);
  passed.readings.rssi.segment(33, 3).setConstant(std::nan(""));
  EXPECT_EQ(passed.otherwise(), 0u);
  Two one;  // the other is heard all the while: something stands in the way
  one.readings.rssi(Eigen::seq(1, 79, 2)).setConstant(-70);
  EXPECT_EQ(one.otherwise(), 0u);
}

}  // namespace
}  // namespace muster::diagnosis
