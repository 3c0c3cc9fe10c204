// What control.navigate takes beside the roadmap, and what it refuses.
#include "navigate_world.hpp"
#include "plugins/controllers/rssi_map.hpp"
#include "roadmap/plan.hpp"
#include "roadmap/rows.hpp"
#include "text/number.hpp"

namespace muster::test {
namespace {

// Levels of a base: -60 dBm in the south, `north` dBm north of 2.2 m.
std::string levels(double north) {
  std::string table = "x[m],y[m],base[dBm]\n";
  for (double x = 0.1; x < 8; x += 0.2)
    for (double y = 0.1; y < 4; y += 0.2)
      table += print_real(x) + ',' + print_real(y) + ',' + (y > 2.2 ? print_real(north) : "-60") + '\n';
  return table;
}

// Whether the way from 1 3.2 to 7 3.2 is by the door in the north, where it is shorter.
bool goes_north(double north, const std::string& weight) {
  const Folder folder;
  folder.write("levels.csv", levels(north));
  Simulation run =
      world_of(folder,
               two_rooms +
                   "<station name='base' at='2 1 1'/><robot name='rover' at='1 3.2 0'/>"
                   "<physics.planar through_walls='true'/><robots.drive/><robots.odometry/>" +
                   plan +
                   "<control.navigate name='steer' robot='rover' goals='goals.csv' rssi='levels.csv' station='base' "
                   "threshold='-70' weight='" +
                   weight + "'/>",
               {{"goals.csv", "x[m],y[m]\n7,3.2\n"}}, minutes);
  bool north_of = false;
  EXPECT_TRUE(
      run_to_goal(run, 1, [&](const Pose& at) { north_of = north_of || (std::abs(at.x - 4) < 0.1 && at.y > 2); }));
  const Navigation now = state_of(run);
  EXPECT_EQ(now.reached, 1);
  return north_of;
}

TEST(NavigateInputs, AWeakLinkMakesAWayCostMore) {
  EXPECT_TRUE(goes_north(-65, "1")) << "above the threshold nothing costs more";
  EXPECT_TRUE(goes_north(-90, "0")) << "without a weight neither";
  EXPECT_FALSE(goes_north(-90, "1"));
}

TEST(NavigateInputs, TheCostIsLengthTimesWhatTheThresholdLacks) {
  // 20 dB below the threshold everywhere, 0.1 for each: three times the length.
  const Folder folder;
  folder.write("levels.csv", "x[m],y[m],base[dBm]\n1,1,-90\n");
  Simulation run = navigating(folder, "3,1\n", "rssi='levels.csv' station='base' threshold='-70' weight='0.1'",
                              "<station name='base' at='2 1 1'/>");
  run.step(), run.step();
  EXPECT_NEAR(state_of(run).length, 2, 1e-9);
  EXPECT_NEAR(state_of(run).cost, 6, 1e-9);
}

TEST(NavigateInputs, TheNearestPlaceIsFoundFromAnywhere) {
  std::vector<RssiPlace> places;  // each with a level of its own
  for (double x = 0; x < 20; x += 0.7)
    for (double y = 0; y < 20; y += 0.7) places.push_back({x, y, static_cast<double>(places.size())});
  const RssiMap map(places);
  const auto away = [](const RssiPlace& place, const roadmap::Point& p) {
    return std::hypot(place.x - p.x, place.y - p.y);
  };
  for (double x = -30; x < 50; x += 2.3) {
    for (double y = -30; y < 50; y += 2.3) {
      double nearest = std::numeric_limits<double>::infinity();
      for (const RssiPlace& place : places) nearest = std::min(nearest, away(place, {x, y}));
      EXPECT_EQ(away(places[static_cast<std::size_t>(map.at({x, y}))], {x, y}), nearest) << x << ' ' << y;
    }
  }
}

// As where the table is of another plan, or in other units.
TEST(NavigateInputs, ATableFarAwayIsLookedUpAtOnce) {
  const std::vector<RssiPlace> places{{0.5, 0.5, -50}, {5.5, 0.5, -60}, {0.5, 5.5, -70}};
  const RssiMap map(places);
  for (const double far : {10.0, 1e4, 1e9}) {
    EXPECT_EQ(map.at({-far, 0.5}), -50);
    EXPECT_EQ(map.at({far, 0.5}), -60);
    EXPECT_EQ(map.at({0.5, far}), -70);
    EXPECT_EQ(map.at({far, far}), -70) << "of two that are equally far the first by x";
  }
  EXPECT_TRUE(is_null(RssiMap(std::vector<RssiPlace>()).at({1e9, 0})));
}

std::string table_of(const std::vector<roadmap::Row>& rows) {
  std::string table = "x0[m],y0[m],x1[m],y1[m],width[m],radius[m]\n";
  for (const roadmap::Row& r : rows) {
    for (const double cell : {r.x0, r.y0, r.x1, r.y1, r.width, r.radius})
      table += (is_null(cell) ? "" : print_real(cell)) + ',';
    table.back() = '\n';
  }
  return table;
}

TEST(NavigateInputs, ARoadmapFromAFileGivesTheWayOfItsOwn) {
  const Folder folder, other;
  Simulation own = navigating(folder, "7,3.5\n");
  ASSERT_TRUE(run_to_goal(own));
  const Table& published = *own.board().find("robot/*/roadmap");
  const auto& bytes = *published.now().blobs[static_cast<std::size_t>(own.table("robot/rover/roadmap").at(0, 6)) - 1];
  std::vector<roadmap::Row> rows(bytes.size() / sizeof(roadmap::Row));
  std::memcpy(rows.data(), bytes.data(), bytes.size());
  other.write("roadmap.csv", table_of(rows));
  Simulation given = navigating(other, "7,3.5\n", "roadmap='roadmap.csv'", "", "");
  ASSERT_TRUE(run_to_goal(given));
  const Pose a = row<Pose>(own, "robot/rover/pose"), b = row<Pose>(given, "robot/rover/pose");
  EXPECT_EQ(given.tick(), own.tick());
  EXPECT_EQ(a.x, b.x);
  EXPECT_EQ(a.y, b.y);
}

std::string refusal(const std::string& attributes, const std::map<std::string, std::string>& files,
                    const std::string& given = plan) {
  const Folder folder;
  for (const auto& [name, text] : files) folder.write(name, text);
  try {
    Simulation run = navigating(folder, "7,1\n", attributes, "<station name='base' at='2 1 1'/>", given);
    run.step(), run.step();
  } catch (const Error& e) {
    return folder.inside(e.what());
  }
  return "";
}

TEST(NavigateInputs, ARoadmapElsewhereIsToldOf) {
  const Folder folder;
  folder.write("way.csv", "x0[m],y0[m],x1[m],y1[m]\n200,100,300,100\n300,100,700,100\n");
  Simulation run = navigating(folder, "7,1\n", "roadmap='way.csv'", "", "");
  run.step();
  EXPECT_THAT(run.events(), testing::Contains(testing::Field(&Event::message,
                                                             testing::HasSubstr("way.csv:2:1: the roadmap begins "))));
}

TEST(NavigateInputs, WhatIsWrongIsNamedOnce) {
  using testing::EndsWith;
  using testing::HasSubstr;
  EXPECT_THAT(refusal("rssi='levels.csv'", {{"levels.csv", levels(-60)}}),
              EndsWith("has rssi and no station; expected station=\"RADIO\", a column of it"));
  EXPECT_THAT(
      refusal("rssi='levels.csv' station='base'", {{"levels.csv", "x[m],y[m],mast[dBm]\n1,1,-60\n"}}),
      EndsWith("the table of rssi has no value in a column base[dBm]; expected that of muster map --from base"));
  EXPECT_THAT(refusal("roadmap='way.csv'", {{"way.csv", "x[m],y[m]\n1,1\n"}}, ""), HasSubstr("way.csv:1:1: "));
  EXPECT_THAT(refusal("roadmap='way.csv'", {{"way.csv", "x0[m],y0[m],x1[m],y1[m]\n1,1,1,1\n"}}, ""),
              EndsWith("way.csv:2:1: the row has no length; expected two different ends"));
  EXPECT_THAT(refusal("", {}, ""), EndsWith("the robot has no roadmap; expected roadmap=\"FILE\" of muster roadmap, or "
                                            "<robots.roadmap robot=\"rover\"/> in the world"));
  EXPECT_EQ(refusal("", {}), "");
}

TEST(NavigateInputs, GoalsThatNoWayLeadsToAreWarnedOfByTheirRows) {
  const auto warnings = [](const std::string& goals) {
    const Folder folder;
    Simulation run = navigating(folder, goals, "", "");
    run.step(), run.step();
    std::string result;
    for (const auto& event : run.events())
      if (const auto at = event.message.find("goals.csv:"); at != std::string::npos)
        result += event.message.substr(at) + '\n';
    return result;
  };
  EXPECT_EQ(warnings("3,1\n7,1\n"), "");
  EXPECT_THAT(warnings("3,1\n30,40\n"),
              testing::StartsWith("goals.csv:3:1: no way to 30.00 40.00: no way leads from 3 1 to 30 40, which lies "
                                  "outside of the plan (x 0 to 8, y "));
  EXPECT_THAT(warnings("30,40\n"), testing::StartsWith("goals.csv:2:1: no way to 30.00 40.00: no way leads from "));
}

TEST(NavigateInputs, ARobotWithoutALaserCannotUseOne) {
  const Folder folder;
  try {
    world_of(folder,
             "<robot name='rover' model='hummingbird' at='1 1 0'/>"
             "<robots.roadmap robot='rover'/><control.navigate robot='rover' goals='goals.csv' laser='true'/>",
             {{"goals.csv", "x[m],y[m]\n7,1\n"}}, minutes);
    FAIL();
  } catch (const Error& e) {
    EXPECT_THAT(std::string(e.what()), testing::HasSubstr(") has no laser; expected fittings="));
  }
}

}  // namespace
}  // namespace muster::test
