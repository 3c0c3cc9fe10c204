// Cells of tables that are read and mean something else: each is told with file, line and column, by `check`.
#include <gmock/gmock.h>

#include "tests/cli/errors/program.hpp"

using namespace muster::test;
using testing::HasSubstr;

namespace {

const std::string base = "<station name=\"base\" at=\"1 1 1\"/>";

// What `check` prints of a world with these elements, whose table t.csv this is, but its last line; its error where it
// refuses the world.
std::string told(const std::string& elements, const std::string& table) {
  const ProgramFolder folder;
  folder.write("t.csv", table);
  folder.write("world.xml", world_of("\n" + elements + "\n"));
  const Outcome outcome = folder.muster({"check", "world.xml"});
  return outcome.exit == 0 ? outcome.out.substr(0, outcome.out.rfind("w: ")) : outcome.err;
}

std::string recorded(const std::string& rows) {
  return told("<robot name=\"rover\" at=\"0 0 0\"/><physics.planar/><control.recorded robot=\"rover\" file=\"t.csv\"/>",
              "t[s],robot,v[m/s],w[rad/s]\n" + rows);
}

TEST(Tables, MarksForNoValue) {
  EXPECT_EQ(recorded("0,rover,0.3,0\n1,rover,9999,0\n"),
            "warning: t.csv:3:9: column \"v[m/s]\": 9999 lies far from all others, 0.3: is it a mark for no value? "
            "expected the table without this row\n");
  EXPECT_THAT(
      recorded("0,rover,0.3,-999\n0.1,rover,0.2,0.5\n0.2,rover,0.2,-999\n"),
      HasSubstr("warning: t.csv:2:13: column \"w[rad/s]\": -999 in 2 rows lies far from all others, 0.5: is it"));
  EXPECT_EQ(recorded("0,rover,0.3,0\n1,rover,0.2,0\n"), "");
}

TEST(Tables, OtherUnits) {
  EXPECT_EQ(recorded("0,rover,0.3,0\n1,rover,0.3,45\n"),
            "warning: t.csv:3:13: column \"w[rad/s]\": 45 rad/s is 7.162 turns a second; are these degrees? 45 degrees "
            "a second are 0.7854 rad/s\n");
  EXPECT_THAT(recorded("43200,rover,0.3,0\n43201,rover,0.3,0\n"),
              HasSubstr("are these seconds of the day? expected seconds of the run: the time less that of its start"));
  EXPECT_THAT(
      recorded("0,rover,0.3,0\n2,rover,0.3,0\n1,rover,0.3,0\n"),
      HasSubstr("t.csv:4:1: time does not rise: 1 s after 2 s; expected the rows of a robot in the order of time"));
}

TEST(Tables, NamesOfOthers) {
  EXPECT_THAT(recorded("0,/rover/base_link,0.3,0\n"),
              HasSubstr("t.csv:2:3: no robot is called \"/rover/base_link\"; expected rover; did you mean \"rover\"?"));
  EXPECT_THAT(recorded("0,1,0.3,0\n"),
              HasSubstr("t.csv:2:3: no robot is called \"1\"; rows hold names, and no numbers: expected rover"));
}

std::string way(const std::string& table) {
  return told("<robot name=\"rover\" at=\"0 0 0\"/><physics.planar/><control.waypoint robot=\"rover\" path=\"t.csv\"/>",
              table);
}

TEST(Tables, HeadersOfOthers) {
  EXPECT_THAT(way("x (m),y (m)\n1,1\n"),
              HasSubstr("t.csv:1:1: column \"x (m)\" means nothing here; expected \"x[m]\"\n"));
  EXPECT_THAT(way("X[M],Y[M]\n1,1\n"), HasSubstr("t.csv:1:1: column \"X\" means nothing here; expected \"x[m]\"\n"));
  EXPECT_THAT(way("x_ft,y_ft\n1,1\n"),
              HasSubstr("column \"x_ft\" means nothing here; expected \"x[m]\": 1 ft is 0.3048 m\n"));
  EXPECT_THAT(way("n,x[m],y[m]\n1,1,1\n2,2,2\n"),
              HasSubstr("t.csv:1:1: column \"n\" counts the rows, and means nothing here; expected the table without "
                        "it: cut -d, -f2- FILE takes it away"));
  EXPECT_THAT(way("lat,lon\n47,8\n"), HasSubstr("places are metres from an origin of your own, x east and y north"));
  EXPECT_EQ(way("x[m],y[m]\n1,1\n-999,-999\n"),
            "warning: t.csv:3:1: column \"x[m]\": -999 lies far from all others, 1: is it a mark for no value? "
            "expected the table without this row\n"
            "warning: t.csv:3:6: column \"y[m]\": -999 lies far from all others, 1: is it a mark for no value? "
            "expected the table without this row\n");
}

TEST(Tables, ASpeedOfNothing) {
  const auto with = [](const std::string& attribute) {
    return told(
        "<robot name=\"rover\" at=\"0 0 0\"/><physics.planar/>\n<control.waypoint robot=\"rover\" path=\"t.csv\" " +
            attribute + "/>",
        "x[m],y[m]\n1,1\n");
  };
  EXPECT_EQ(with("speed=\"0\""),
            "warning: world.xml:3:53: attribute \"speed\": 0 m/s: the robot never moves; expected a speed above 0\n");
  EXPECT_THAT(with("turn_speed=\"0\""), HasSubstr("0 rad/s: the robot never turns to where it is to go"));
  EXPECT_EQ(with("speed=\"0.1\""), "");
}

TEST(Tables, RoadmapsOfOthers) {
  const auto by = [](const std::string& roadmap) {
    return told(
        "<robot name=\"rover\" at=\"0 0 0\"/><physics.planar/><control.navigate robot=\"rover\" roadmap=\"t.csv\"/>",
        roadmap);
  };
  EXPECT_THAT(by("x[m],y[m]\n1,2\n"), HasSubstr("these are places one after the other, and a roadmap is pieces between "
                                                "places; expected x0[m],y0[m],x1[m],y1[m]"));
  EXPECT_THAT(by("from,to,weight\n1,2,3\n"), HasSubstr("these are pieces between numbers, and a roadmap is pieces"));
}

TEST(Tables, ValuesThatHaveNoEffect) {
  const auto areas = [](const std::string& rows) {
    return told(
        "<robot name=\"rover\" at=\"0 0 0\"/><physics.planar/><sensors.gps robot=\"rover\" latitude=\"47\" "
        "longitude=\"8\" areas=\"t.csv\"/>",
        "x0[m],y0[m],x1[m],y1[m]\n" + rows);
  };
  EXPECT_THAT(areas("3,3,3,9\n"),
              HasSubstr("warning: t.csv:2:5: the area has no width: x1 is x0, so that no robot is in it"));
  EXPECT_THAT(areas("47.1,8.5,47.2,8.6\n"),
              HasSubstr("t.csv:2:1: the area is less than 0.5 m wide; are these latitude"));
  EXPECT_THAT(areas("1,1,9,5\n"), testing::Not(HasSubstr("t.csv")));
  const auto biases = [](const std::string& rows) {
    return told(base +
                    "<robot name=\"rover\" at=\"0 0 0\"/><physics.planar/><sensors.range robot=\"rover\" "
                    "peers=\"base\" biases=\"t.csv\"/>",
                "a,b,bias[m]\n" + rows);
  };
  EXPECT_THAT(biases("rover,base,120\n"),
              HasSubstr("warning: t.csv:2:12: a bias of 120 m; is this millimetres? 120 mm are 0.12 m"));
  EXPECT_THAT(biases("rover,rover,0.1\n"), HasSubstr("t.csv:2:7: rover measures no range to itself"));
  EXPECT_THAT(biases("rover,base,0.12\n"), testing::Not(HasSubstr("t.csv")));
}

TEST(Tables, LaserBiasesBeyondTheLaser) {
  const auto biases = [](const std::string& rows) {
    return told(
        "<robot name=\"rover\" model=\"scarab\" at=\"0 0 0\"/><physics.planar/><sensors.laser biases=\"t.csv\"/>",
        "range[m],bias[m]\n" + rows);
  };
  EXPECT_THAT(biases("100,1\n5000,20\n"),
              HasSubstr("warning: t.csv:3:1: a range of 5000 m, and no laser here reaches further than 4 m"));
  EXPECT_THAT(biases("-1,0.1\n"),
              HasSubstr("t.csv:2:1: column \"range[m]\": -1 is negative; expected a number from 0, in m"));
  EXPECT_THAT(biases("0.1,0.01\n5,0.02\n"), testing::Not(HasSubstr("t.csv")));
}

TEST(Tables, AttitudesOfOtherAutopilots) {
  const auto flown = [](const std::string& row) {
    return told(
        "<robot name=\"drone\" model=\"hummingbird\" at=\"0 0 2\"/><physics.simbody/><control.attitude "
        "robot=\"drone\" file=\"t.csv\"/>",
        "t[s],cmd_thrust[N],cmd_roll[rad],cmd_pitch[rad],cmd_yaw_rate[rad/s]\n0," + row + "\n");
  };
  EXPECT_THAT(
      flown("7,5,0,0"),
      HasSubstr("warning: t.csv:2:5: cmd_roll is 5 rad, on its head; are these degrees? 5 degrees are 0.0873 rad"));
  EXPECT_THAT(flown("-7,0,0,0"),
              HasSubstr("t.csv:2:3: cmd_thrust of -7 N points down; is it negative upward, as in PX4?"));
  EXPECT_THAT(flown("716,0,0,0"), HasSubstr("times the robot's weight; are these grams? 716 g are 7.024 N"));
  EXPECT_THAT(flown("1500,0,0,0"), HasSubstr("are these pulses in microseconds, or grams?"));
  EXPECT_THAT(flown("7,0.1,0,0"), testing::Not(HasSubstr("t.csv")));
}

TEST(Tables, WayPointsThatNobodyReaches) {
  const auto flown = [](const std::string& row) {
    return told(
        "<robot name=\"drone\" model=\"hummingbird\" at=\"0 0 0.06\"/><physics.simbody/><control.velocity3d "
        "robot=\"drone\"/><control.path3d robot=\"drone\" path=\"t.csv\"/>",
        "x[m],y[m],z[m]\n" + row + "\n");
  };
  EXPECT_THAT(flown("1,2,1500"),
              HasSubstr("warning: t.csv:2:1: a way point 1500 m away, where the robot does not come"));
  EXPECT_THAT(flown("1,2,-2"), HasSubstr("warning: t.csv:2:5: z = -2 m is below the ground"));
  EXPECT_THAT(flown("1,2,2"), testing::Not(HasSubstr("t.csv")));
}

}  // namespace
