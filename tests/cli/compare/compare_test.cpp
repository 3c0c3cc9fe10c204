// What a comparison finds, against truth that is known by a formula.
#include <cmath>

#include "compared.hpp"

namespace muster::test {
namespace {

using testing::HasSubstr;
using testing::Not;

const std::string faster = "steer=control.waypoint:speed=0.4";

TEST(Compare, RunsThatAreTheSameDoNotDiffer) {
  const CompareFolder folder;
  folder.write("world.xml", drive_world("<robots.drive noise=\"0.05\"/>"));
  // A bound on the acceleration that is never met changes no bit: the noise is the same in both runs.
  const auto json = folder.json({"world.xml", "physics=physics.planar:acceleration=1e6"});
  const auto& one = json["comparisons"][0];
  EXPECT_EQ(one["same"], true);
  EXPECT_EQ(one["first"], nullptr);
  EXPECT_EQ(one["differences"].size(), 0u);
  EXPECT_EQ(one["ticks"], 80);
  EXPECT_EQ(one["common_random_numbers"], true);
  EXPECT_EQ(json["runs"][0]["digest"], json["runs"][1]["digest"]);
  const auto outcome = folder.muster({"compare", "world.xml", "physics=physics.planar:acceleration=1e6"});
  EXPECT_EQ(outcome.exit, 0) << outcome.err;
  EXPECT_THAT(outcome.out,
              HasSubstr("B against A: no difference, to t = 4 s: the same bits in every table and tick\n"));
}

// Along a line, behind a ramp of 2 m/s2: x = v t - v^2 / 4.
TEST(Compare, MeasuresTheDistanceBetweenTwoSpeeds) {
  const CompareFolder folder;
  folder.write("world.xml", drive_world());
  const auto one = folder.json({"world.xml", faster})["comparisons"][0];
  EXPECT_EQ(one["same"], false);
  const auto distance = course(one, "robot/*/pose", "r", "distance");
  EXPECT_NEAR(distance["end"].get<double>(), 0.1 * 4 - (0.16 - 0.09) / 4, 1e-9);
  EXPECT_NEAR(distance["largest"].get<double>(), distance["end"].get<double>(), 0);
  EXPECT_EQ(distance["largest_at_tick"], 80);
  EXPECT_EQ(distance["first_tick"], 4) << "to 0.3 m/s both have the same ramp, of three ticks";
  EXPECT_EQ(distance["unit"], "m");
  EXPECT_EQ(course(one, "robot/*/pose", "r", "heading"), nullptr);
  EXPECT_EQ(course(one, "robot/*/command", "r", "w"), nullptr);
  const auto command = course(one, "robot/*/command", "r", "v");
  EXPECT_DOUBLE_EQ(command["end"].get<double>(), 0.4 - 0.3);
  EXPECT_EQ(command["first_tick"], 1);
}

TEST(Compare, NamesTheFirstCellThatDiffersAndWhoWroteIt) {
  const CompareFolder folder;
  folder.write("world.xml", drive_world());
  const auto first = folder.json({"world.xml", faster})["comparisons"][0]["first"];
  EXPECT_EQ(first["tick"], 1);
  EXPECT_EQ(first["table"], "robot/*/command");
  EXPECT_EQ(first["row"], "r");
  EXPECT_EQ(first["column"], "v[m/s]");
  EXPECT_EQ(first["values"], nlohmann::json({"0.3", "0.4"}));
  EXPECT_EQ(first["writers"], nlohmann::json({"steer (control.waypoint/2)", "steer (control.waypoint/2)"}));
  EXPECT_THAT(folder.muster({"compare", "world.xml", faster}).out,
              HasSubstr("B against A, to t = 4 s\n"
                        "  first     tick 1 (t = 0.05 s): robot/*/command, row r, v[m/s]\n"
                        "            A = 0.3, by steer (control.waypoint/2)\n"
                        "            B = 0.4, by steer (control.waypoint/2)\n"));
}

// Not in the order of names: a body moves before its radio is heard.
TEST(Compare, NamesTheCauseBeforeWhatFollowsFromIt) {
  const CompareFolder folder;
  folder.write("world.xml", drive_world("<station name=\"base\" at=\"0 0 1\"/><control.beacon radio=\"base\"/>"
                                        "<network.ideal/><radio.multiwall tx_power=\"0\" l0=\"40\" n=\"2\"/>"));
  const auto one = folder.json({"world.xml", "physics=physics.planar:acceleration=1"})["comparisons"][0];
  ASSERT_NE(course(one, "link/*/level", "base r", "level"), nullptr);
  EXPECT_EQ(course(one, "link/*/level", "base r", "level")["first_tick"], one["first"]["tick"]);
  EXPECT_EQ(one["first"]["table"], "robot/*/pose");
  EXPECT_EQ(one["first"]["writers"][0], "physics (physics.planar/1)");
}

// A heading is told round the circle: from just under half a turn to just over it is a step of 0.02.
TEST(Compare, TakesTheShorterWayRoundTheCircle) {
  const CompareFolder folder;
  for (const char* heading : {"3.13", "3.15"})
    folder.write(std::string(heading) + ".xml",
                 "<world dt=\"0.1\" until=\"1\"><robot name=\"r\" at=\"0 0 0\" heading=\"" + std::string(heading) +
                     "\"/><physics.planar/></world>");
  const auto one = folder.json({"3.13.xml", "3.15.xml"})["comparisons"][0];
  EXPECT_NEAR(course(one, "robot/*/pose", "r", "heading")["end"].get<double>(), 0.02, 1e-12);
  EXPECT_EQ(one["first"]["tick"], 0);
  EXPECT_EQ(one["first"]["table"], "robot/*/pose");
  EXPECT_EQ(one["first"]["column"], "qw");
}

// Rows are what they are called, in whatever order the file has them.
TEST(Compare, PairsRowsByName) {
  const CompareFolder folder;
  const std::string r = "<robot name=\"r\" at=\"0 0 0\"/>", s = "<robot name=\"s\" at=\"0 5 0\"/>",
                    drive =
                        "<robots.drive noise=\"0.1\"/><physics.planar/>"
                        "<control.waypoint name=\"to_r\" robot=\"r\" path=\"way.csv\"/>"
                        "<control.waypoint name=\"to_s\" robot=\"s\" path=\"way.csv\"/></world>";
  const std::string head = "<world dt=\"0.1\" until=\"2\">";
  folder.write("one.xml", head + r + s + drive);
  folder.write("other.xml", head + s + r + drive);
  folder.write("more.xml", head + r + s + "<robot name=\"t\" at=\"0 9 0\"/>" + drive);
  const auto json = folder.json({"one.xml", "other.xml", "more.xml"});
  EXPECT_NE(json["runs"][0]["digest"], json["runs"][1]["digest"]) << "the files have the same order";
  // Numbers of rows stand in the state of drive and odometry alone.
  for (const auto& one : json["comparisons"][0]["differences"])
    EXPECT_THAT(one["table"], testing::AnyOf("robot/*/drive_reached", "robot/*/odometry_seen", "robot/*/body")) << one;
  const auto& more = json["comparisons"][1];
  EXPECT_THAT(more["only"]["C"], testing::Contains("robot/t"));
  EXPECT_EQ(more["only"]["A"].size(), 0u);
  EXPECT_EQ(more["differences"].size(), 0u) << "a robot that comes disturbs none that are there";
}

TEST(Compare, CountsMessagesAndLevelsOfLinksByTheirEnds) {
  const CompareFolder folder;
  const auto world = [](const char* at) {
    return "<world dt=\"0.1\" until=\"2\"><station name=\"base\" at=\"0 0 1\"/><station name=\"far\" at=\"" +
           std::string(at) +
           " 0 1\"/><radio.multiwall tx_power=\"0\" l0=\"40\" n=\"2\"/><network.ideal/>"
           "<control.beacon name=\"calls\" radio=\"base\" period=\"0.1\"/></world>";
  };
  folder.write("world.xml", world("10"));
  folder.write("further.xml", world("20"));
  const auto json = folder.json({"world.xml", "calls=control.beacon:period=0.2", "further.xml"});
  const auto fewer = course(json["comparisons"][0], "inbox/*/message", "far base", "count");
  EXPECT_EQ(fewer["end"], -10) << "of 20 messages";
  EXPECT_EQ(course(json["comparisons"][0], "link/*/level", "base far", "level"), nullptr);
  const auto& first = json["comparisons"][0]["first"];
  EXPECT_EQ(first["table"], "outbox/*/message");
  EXPECT_EQ(first["row"], "base");
  EXPECT_EQ(first["values"], nlohmann::json({"there", "not there"}));
  EXPECT_EQ(first["writers"], nlohmann::json({"calls (control.beacon/1)", "calls (control.beacon/1)"}));
  const auto level = course(json["comparisons"][1], "link/*/level", "base far", "level");
  EXPECT_NEAR(level["end"].get<double>(), -20 * std::log10(2), 1e-9);
  EXPECT_EQ(level["unit"], "dB") << "levels in dBm differ by dB";
  EXPECT_EQ(course(json["comparisons"][1], "inbox/*/message", "far base", "count"), nullptr);
}

TEST(Compare, SaysThatSeedsDiffer) {
  const CompareFolder folder;
  folder.write("one.xml", drive_world("<robots.drive noise=\"0.05\"/>", "seed=\"1\""));
  folder.write("two.xml", drive_world("<robots.drive noise=\"0.05\"/>", "seed=\"2\""));
  const auto outcome = folder.muster({"compare", "one.xml", "two.xml"});
  EXPECT_THAT(outcome.out, HasSubstr("The seeds differ, and with them the random numbers.\n"));
  EXPECT_THAT(outcome.out, Not(HasSubstr("Common random numbers")));
  const auto one = folder.json({"one.xml", "two.xml"})["comparisons"][0];
  EXPECT_EQ(one["common_random_numbers"], false);
  EXPECT_EQ(one["first"]["table"], "robot/*/drive");
  EXPECT_EQ(folder.json({"one.xml", "two.xml", "--seed", "3"})["comparisons"][0]["same"], true);
}

TEST(Compare, WritesATableAPictureAndBothRecords) {
  const CompareFolder folder;
  folder.write("world.xml", drive_world("<record table=\"robot/*/pose\"/>"));
  const auto one = folder.json({"world.xml", faster, "--out", "out"})["comparisons"][0];
  const std::string table = folder.read("out/divergence.csv");
  EXPECT_THAT(table,
              testing::StartsWith("t[s],run,table,row,quantity,unit,difference\n0.05,B,robot/*/command,r,v,m/s,"));
  const std::string distance = course(one, "robot/*/pose", "r", "distance")["end"].dump();
  EXPECT_THAT(table, HasSubstr("\n4,B,robot/*/pose,r,distance,m," + distance + '\n'));
  EXPECT_THAT(folder.read("out/divergence.svg"), HasSubstr("robot/*/pose distance"));
  EXPECT_THAT(folder.read("out/A/plan.svg"), HasSubstr(">Ways so far.<"));  // no radio, no RSSI
  EXPECT_THAT(folder.read("out/A/robot_pose.csv"), HasSubstr("\n4,r,1.17"));
  EXPECT_THAT(folder.read("out/B/robot_pose.csv"), HasSubstr("\n4,r,1.5"));
}

}  // namespace
}  // namespace muster::test
