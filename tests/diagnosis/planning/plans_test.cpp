// Plans for one robot that receives from two stations: their changes, and all that they keep.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "diagnosis/inference/thresholds.hpp"
#include "diagnosis/planning/measurement_plans.hpp"

namespace muster::diagnosis {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

enum Radio { west, east, robot };
const Vector3d stands[] = {{0, 0, 2}, {12, 0, 2}};
constexpr double faces[] = {0.3, -0.5};  // rad
constexpr int moments = 30;

// From west and from east in turn, a row a second; the robot drives along y = 4 with its heading along the path.
RowSummary driven(bool robot_sends = false) {
  RowSummary seen;
  seen.radios = {"west", "east", "robot"};
  constexpr Index rows = 2 * moments;
  seen.tx_at.resize(3, rows);
  seen.rx_at.resize(3, rows);
  seen.t.resize(rows);
  seen.tx_yaw.resize(rows);
  seen.rx_yaw.resize(rows);
  seen.count = Eigen::VectorXd::Constant(rows, 2);
  for (Index i = 0; i < rows; ++i) {
    const int station = i % 2 == 0 ? west : east;
    const Index second = i / 2;
    const auto moment = static_cast<double>(second);
    const Vector3d at(0.4 * moment, 4, 0.4);
    seen.tx.push_back(robot_sends ? static_cast<int>(robot) : station);
    seen.rx.push_back(robot_sends ? station : static_cast<int>(robot));
    (robot_sends ? seen.rx_at : seen.tx_at).col(i) = stands[station];
    (robot_sends ? seen.tx_at : seen.rx_at).col(i) = at;
    (robot_sends ? seen.rx_yaw : seen.tx_yaw)[i] = faces[station];
    (robot_sends ? seen.tx_yaw : seen.rx_yaw)[i] = 0;
    seen.t[i] = 1000.0905 + moment;  // written as 1000.091, like a millisecond later
  }
  seen.walls = {{"w1", "brick", -2, -8, 14, -8, 0.1}, {"w2", "brick", 14, -8, 14, 8, 0.1}};
  return seen;
}

CauseEstimate about(const std::string& radio) {
  CauseEstimate c;
  c.row = radio;
  return c;
}

LinkReadings plan(const RowSummary& seen, const std::string& says, const std::vector<CauseEstimate>& found = {}) {
  for (const PlannedReadings& p : planned_readings(seen, found)) {
    if (p.say.find(says) != std::string::npos) return p.readings;
  }
  return {};
}

// True if the stations' ends keep place and heading. False if a link has no station.
bool stations_stay(const LinkReadings& r) {
  for (Index i = 0; i < r.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    const bool down = r.tx[k] != robot;
    const int station = down ? r.tx[k] : r.rx[k];
    if (station == robot) return false;
    if ((down ? r.tx_at : r.rx_at).col(i) != stands[station]) return false;
    if ((down ? r.tx_yaw : r.rx_yaw)[k] != faces[station]) return false;
  }
  return true;
}

TEST(Plans, MakeNoTwoReadingsOfALinkAtOnceAndNoneBeforeTheData) {
  for (const bool robot_sends : {false, true}) {
    const RowSummary seen = driven(robot_sends);
    const auto plans = planned_readings(seen, {});
    EXPECT_EQ(plans.size(), 7u);
    for (const PlannedReadings& p : plans) {
      std::set<std::tuple<int, int, std::string>> known;  // with times as written
      for (std::size_t k = 0; k < p.readings.tx.size(); ++k) {
        EXPECT_TRUE(known.insert({p.readings.tx[k], p.readings.rx[k], fmt::format("{:.3f}", p.readings.t[k])}).second)
            << p.say;
        EXPECT_GT(p.readings.t[k], seen.t.maxCoeff()) << p.say;
      }
      EXPECT_EQ(p.readings.tx_at.cols(), p.readings.size()) << p.say;
      EXPECT_EQ(p.readings.tx_yaw.size(), p.readings.tx.size()) << p.say;
      EXPECT_EQ(p.readings.rx_yaw.size(), p.readings.rx.size()) << p.say;
    }
  }
}

TEST(Plans, DriveBackAgainWithTheRobotTurnedRoundAndTheStationsAsTheyWere) {
  for (const bool robot_sends : {false, true}) {
    const LinkReadings back = plan(driven(robot_sends), "in reverse");
    ASSERT_EQ(back.size(), 4 * moments);  // two readings a row, as in the data
    EXPECT_TRUE(stations_stay(back));
    for (const double yaw : robot_sends ? back.tx_yaw : back.rx_yaw) EXPECT_DOUBLE_EQ(yaw, M_PI);
    const auto first = static_cast<Index>(std::min_element(back.t.begin(), back.t.end()) - back.t.begin());
    EXPECT_NEAR((robot_sends ? back.tx_at : back.rx_at)(0, first), 0.4 * (moments - 1), 1e-12);
    const LinkReadings later = plan(driven(robot_sends), "in the same order");
    EXPECT_TRUE(stations_stay(later));
    for (const double yaw : robot_sends ? later.tx_yaw : later.rx_yaw) EXPECT_EQ(yaw, 0);
  }
}

TEST(Plans, LetBothEndsSendWhereOneDid) {
  const LinkReadings both = plan(driven(), "both ends");
  EXPECT_TRUE(stations_stay(both));
  std::map<std::pair<int, int>, int> many;
  for (std::size_t k = 0; k < both.tx.size(); ++k) ++many[{both.tx[k], both.rx[k]}];
  for (const int station : {west, east}) {
    const int down = many[{station, robot}], up = many[{robot, station}];
    EXPECT_EQ(down, 2 * moments);
    EXPECT_EQ(up, down);
  }
  RowSummary already = driven();
  std::swap(already.tx[0], already.rx[0]);
  EXPECT_EQ(plan(already, "both ends").size(), 0);
}

TEST(Plans, TurnOrMoveTheStationThatSomethingWasFoundAbout) {
  for (const bool robot_sends : {false, true}) {
    for (const int concerned : {west, east}) {
      const RowSummary seen = driven(robot_sends);
      const std::string name = seen.radios[static_cast<std::size_t>(concerned)];
      const LinkReadings turned = plan(seen, "turn " + name + " by 90 degrees", {about("robot"), about(name)});
      const LinkReadings moved = plan(seen, "move " + name, {about(name)});
      ASSERT_GT(turned.size(), 0) << name;
      ASSERT_GT(moved.size(), 0) << name;
      const auto radio = [&](const LinkReadings& r) { return robot_sends ? r.rx : r.tx; };
      const auto at = [&](const LinkReadings& r) { return robot_sends ? r.rx_at : r.tx_at; };
      const auto yaw = [&](const LinkReadings& r) { return robot_sends ? r.rx_yaw : r.tx_yaw; };
      for (Index i = 0; i < turned.size(); ++i) {
        EXPECT_EQ(radio(turned)[static_cast<std::size_t>(i)], concerned);
        EXPECT_EQ(at(turned).col(i), stands[concerned]);
        EXPECT_DOUBLE_EQ(yaw(turned)[static_cast<std::size_t>(i)], faces[concerned] + M_PI / 2);
      }
      for (Index i = 0; i < moved.size(); ++i) {
        EXPECT_EQ(radio(moved)[static_cast<std::size_t>(i)], concerned);
        EXPECT_EQ(yaw(moved)[static_cast<std::size_t>(i)], faces[concerned]);
        EXPECT_EQ(at(moved).col(i), at(moved).col(0));  // one place, on the path, at the station's own height
        EXPECT_EQ(at(moved)(1, i), 4);
        EXPECT_EQ(at(moved)(2, i), 2);
      }
    }
  }
}

// With both ends sending, the place of a row is never the station's.
TEST(Plans, KeepStationsWhereTheyAreOnLinksThatGoBothWays) {
  RowSummary seen = driven();
  for (const std::size_t k : {2u, 3u, 40u, 41u}) {
    std::swap(seen.tx[k], seen.rx[k]);
    seen.tx_at.col(static_cast<Index>(k)).swap(seen.rx_at.col(static_cast<Index>(k)));
    std::swap(seen.tx_yaw[static_cast<Index>(k)], seen.rx_yaw[static_cast<Index>(k)]);
  }
  for (const char* says : {"in reverse", "in the same order", "once around", "nothing was measured"}) {
    const LinkReadings r = plan(seen, says);
    EXPECT_GT(r.size(), 0) << says;
    EXPECT_TRUE(stations_stay(r)) << says;
  }
  for (const char* says : {"turn east by", "move east"}) {
    const LinkReadings r = plan(seen, says, {about("east")});
    std::set<std::pair<int, int>> links;
    for (std::size_t k = 0; k < r.tx.size(); ++k) links.insert({r.tx[k], r.rx[k]});
    EXPECT_EQ(links, (std::set<std::pair<int, int>>{{east, robot}, {robot, east}})) << says;
  }
}

TEST(Plans, TurnTheStationOfAnAlternativeWhereTheFindingConcernsNone) {
  CauseEstimate wall = about("w1");
  wall.alternatives = {{"effect.tx_offset", "radio/west", {}, 1, 2 * inference::thresholds::decided},
                       {"effect.antenna_tx", "radio/east", {}, 2, 0}};
  EXPECT_GT(plan(driven(), "turn east", {wall}).size(), 0);
  EXPECT_EQ(plan(driven(), "turn west", {wall}).size(), 0);
  EXPECT_GT(plan(driven(), "turn west", {wall, about("west")}).size(), 0);
}

TEST(Plans, TurnTheRobotOnceAroundAtEveryPlace) {
  const LinkReadings turning = plan(driven(), "once around");
  EXPECT_TRUE(stations_stay(turning));
  std::map<double, std::set<double>> headings;  // by place
  for (Index i = 0; i < turning.size(); ++i)
    headings[turning.rx_at(0, i)].insert(turning.rx_yaw[static_cast<std::size_t>(i)]);
  EXPECT_GE(headings.size(), 20u);
  for (const auto& [place, yaws] : headings) EXPECT_EQ(yaws.size(), 12u) << place;
}

TEST(Plans, GoWhereNothingWasMeasuredAndNotFarFromWhatWasFound) {
  CauseEstimate found;
  found.values = {{"x", "m", 10, 1, 8, 12, -100, 100}, {"y", "m", -4, 1, -6, -2, -100, 100}};
  const LinkReadings there = plan(driven(), "nothing was measured", {found});
  ASSERT_GT(there.size(), 0);
  EXPECT_TRUE(stations_stay(there));
  const RowSummary seen = driven();
  for (Index i = 0; i < there.size(); ++i) {
    const auto at = there.rx_at.col(i).head<2>();
    EXPECT_GT((seen.rx_at.topRows<2>().colwise() - at).colwise().norm().minCoeff(), 1.5);
    EXPECT_LT((at - Eigen::Vector2d(10, -4)).norm(), 8);
  }
}

TEST(Plans, AreNoneWherePlacesAreUnknown) {
  RowSummary seen = driven();
  seen.places_known = false;
  EXPECT_TRUE(planned_readings(seen, {}).empty());
}

// The first of two causes is stronger, and has two open alternatives.
Diagnosis open_towards_two(double by_one, double by_other) {
  Diagnosis d;
  d.causes.resize(2);
  d.causes[0].id = "effect.a";
  d.causes[1].id = "effect.b";
  d.advice = {{"other", "effect.b", "effect.z", 1, 24.0},
              {"one", "effect.a", "effect.x", 4, 4 + by_one},
              {"other", "effect.a", "effect.x", 4, 4.0},
              {"one", "effect.a", "effect.y", 9, 9.0},
              {"other", "effect.a", "effect.y", 9, 9 + by_other}};
  return d;
}

TEST(MostTelling, IsThePlanThatMakesTheStrongestCauseGrowMost) {
  const std::vector<PlannedReadings> plans{{"one", {}}, {"other", {}}};
  EXPECT_EQ(most_telling(open_towards_two(12, 5), plans)->say, "one");
  EXPECT_EQ(most_telling(open_towards_two(12, 14), plans)->say, "other");
  EXPECT_EQ(most_telling(open_towards_two(17, 1000), plans)->say, "one");  // decided at 25: 9 lacks 16
}

TEST(MostTelling, IsNoneWhereNoPlanAddsAnything) {
  const std::vector<PlannedReadings> plans{{"one", {}}, {"other", {}}};
  EXPECT_FALSE(most_telling(open_towards_two(0.4, 0.9), plans).has_value());
  EXPECT_FALSE(most_telling(Diagnosis{}, plans).has_value());
}

}  // namespace
}  // namespace muster::diagnosis
