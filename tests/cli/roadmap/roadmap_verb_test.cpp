// The verb against the closed form of a box, and its words.
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/cli/errors/program.hpp"
#include "text/text_table.hpp"

namespace muster::test {
namespace {

using nlohmann::json;
using testing::ElementsAre;

// A wall from -2 0 to 2 0, 2 m thick. For a robot of 0.5 m it ends at 2.5 and 1.5.
const std::string box =
    "<material name=\"brick\" loss=\"6\"/><wall name=\"box\" from=\"-2 0\" to=\"2 0\" thickness=\"2\" "
    "material=\"brick\"/>";
const std::string rover = "<robot name=\"rover\" at=\"-5 0.1 0\"/>";

json figures(const ProgramFolder& folder, std::vector<std::string> words) {
  words.insert(words.begin(), {"roadmap", "world.xml", "--out", "roadmap.csv", "--json"});
  const Outcome outcome = folder.muster(words);
  EXPECT_EQ(outcome.exit, 0) << outcome.err;
  return json::parse(outcome.out);
}

TEST(RoadmapVerb, Row49WritesPiecesWallsAndTheShortestWay) {
  const ProgramFolder folder;
  folder.write("world.xml", world_of(box));
  const json made = figures(folder, {"--radius", "0.5", "--margin", "0", "--room", "5", "--from", "-5", "0.1", "--to",
                                     "5", "0.1", "--path", "way.csv"});
  EXPECT_EQ(made["nodes"], 4);
  EXPECT_EQ(made["edges"], 4);
  EXPECT_EQ(made["branches"], 0);
  EXPECT_EQ(made["components"], 1);
  EXPECT_NEAR(made["way_m"].get<double>(), 5 + 2 * std::hypot(2.5, 1.4), 1e-9);
  EXPECT_NEAR(made["area_m2"].get<double>() - made["free_m2"].get<double>(), 5 * 3, 0.3);
  const TextTable rows = TextTable::read(folder / "roadmap.csv"), way = TextTable::read(folder / "way.csv");
  EXPECT_EQ(rows.rows(), 5u) << "four sides and a wall";
  EXPECT_EQ(rows.reals(rows.require("radius", "m"), {true, false})[4], 0.5);
  EXPECT_THAT(way.reals(way.require("x", "m")), ElementsAre(-5, -2.5, 2.5, 5));
  EXPECT_THAT(way.reals(way.require("y", "m")), ElementsAre(0.1, 1.5, 1.5, 0.1));
}

TEST(RoadmapVerb, Row49TheWayIsOneThatOtherControllersFollow) {
  const ProgramFolder folder;
  folder.write("world.xml", world_of(box + rover));
  figures(folder, {"--to", "5", "0.1", "--path", "way.csv"});
  folder.write("drive.xml",
               world_of(box + rover +
                        "<physics.planar through_walls=\"true\"/><robots.drive/><robots.odometry/>"
                        "<control.waypoint name=\"steer\" robot=\"rover\" path=\"way.csv\" speed=\"0.5\"/>"));
  const Outcome run = folder.muster({"run", "drive.xml", "--until", "40", "--out", "out", "--record", "robot/*/pose"});
  ASSERT_EQ(run.exit, 0) << run.err;
  const TextTable poses = TextTable::read(folder / "out/robot_pose.csv");
  const auto x = poses.reals(poses.require("x", "m")), y = poses.reals(poses.require("y", "m"));
  EXPECT_NEAR(x.back(), 5, 0.15);
  for (std::size_t i = 0; i < x.size(); ++i)
    EXPECT_FALSE(std::abs(x[i]) < 2.15 && std::abs(y[i]) < 1.15) << "it keeps off the box: " << x[i] << ' ' << y[i];
}

TEST(RoadmapVerb, ARobotsRadiusIsOfItsModelAndAGridIsALattice) {
  const ProgramFolder folder;
  folder.write("world.xml", world_of(box + rover));
  const json visibility = figures(folder, {"--margin", "0"});
  EXPECT_NEAR(visibility["radius_m"].get<double>(), 0.1524, 0.001);
  const json grid = figures(folder, {"--method", "grid", "--step", "1", "--room", "2"});
  EXPECT_EQ(grid["method"], "grid");
  EXPECT_GT(grid["branches"].get<int>(), 20);
  EXPECT_EQ(grid["components"], 1);
}

const std::string room =
    "<material name=\"brick\" loss=\"6\"/><wall name=\"s\" from=\"0 0\" to=\"6 0\" material=\"brick\"/>"
    "<wall name=\"e\" from=\"6 0\" to=\"6 4\" material=\"brick\"/><wall name=\"n\" from=\"6 4\" to=\"0 4\" "
    "material=\"brick\"/><wall name=\"w\" from=\"0 4\" to=\"0 0\" material=\"brick\"/>"
    "<door name=\"d\" wall=\"s\" at=\"2\"/>";

TEST(RoadmapVerb, WarnsOfARobotThatCannotReachItsGoalOrStandsInAWall) {
  const ProgramFolder folder;
  folder.write("world.xml", world_of(room + "<robot name=\"in\" at=\"3 2 0\"/><robot name=\"stuck\" at=\"6 3 0\"/>"));
  EXPECT_THAT(figures(folder, {"--radius", "0.2", "--margin", "0"})["warnings"],
              ElementsAre("robot \"stuck\" stands in no free space, 0 m from a wall; expected at least 0.2 m on all "
                          "sides"));
  const json closed = figures(folder, {"--robot", "in", "--to", "-1", "-1"});
  EXPECT_THAT(
      closed["warnings"],
      ElementsAre("--to: no way leads from 3 2 to -1 -1, which lies outside of the plan (x 0 to 6, y 0 to 4 m)"));
  EXPECT_EQ(closed["components"], 1) << "corners are outside alone";
  const json open = figures(folder, {"--robot", "in", "--to", "-1", "-1", "--open-doors"});
  EXPECT_TRUE(open["warnings"].empty());
  EXPECT_EQ(open["components"], 1);

  folder.write("goals.csv", "x[m],y[m]\n1,1\n-1,-1\n");
  folder.write(
      "world.xml",
      world_of(room + "<robot name=\"in\" at=\"3 2 0\"/><physics.planar through_walls=\"true\"/><robots.drive/>"
                      "<robots.odometry/><robots.roadmap robot=\"in\"/>"
                      "<control.navigate robot=\"in\" goals=\"goals.csv\"/>"));
  EXPECT_THAT(figures(folder, {})["warnings"],
              ElementsAre("robot \"in\" cannot reach its goal: no way leads from 1 1 to -1 -1, which lies outside of "
                          "the plan (x 0 to 6, y 0 to 4 m)"));
}

TEST(RoadmapVerb, RefusesWordsThatItCannotUse) {
  const ProgramFolder folder;
  folder.write("world.xml", world_of(room + "<robot name=\"one\" at=\"3 2 0\"/><robot name=\"two\" at=\"1 2 0\"/>"));
  folder.write("empty.xml", world_of("<material name=\"brick\" loss=\"6\"/>"));
  const auto refused = [&](std::vector<std::string> words, const std::string& message,
                           const char* world = "world.xml") {
    words.insert(words.begin(), {"roadmap", world, "--out", "roadmap.csv"});
    expect_error(folder.muster(words), 2, message);
    EXPECT_FALSE(std::filesystem::exists(folder / "roadmap.csv")) << message;
  };
  refused({}, "world.xml: the world has 2 robots; expected --robot NAME or --radius R");
  refused({"--robot", "oen"}, "--robot: no robot is called \"oen\"; expected one of one, two; did you mean \"one\"?");
  refused({"--radius", "30"},
          "--radius: 30 m, with which no robot of the world has room where it stands; is this in centimetres? expected "
          "--radius 0.3");
  refused(
      {"--radius", "300"},
      "--radius: 300 m, with which no robot of the world has room where it stands; is this in millimetres? expected "
      "--radius 0.3");
  refused({"--radius", "-1"}, "--radius: -1 m; expected metres from 0.001 to 1000");
  refused({"--robot", "one", "--path", "way.csv"}, "--path needs a goal; expected --to X Y beside it");
  refused({"--radius", "0.2", "--to", "1", "1"},
          "--to needs a start; expected --from X Y, or --robot NAME in place of --radius");
  refused({"--robot", "one", "--to", "-1", "-1", "--path", "way.csv"},
          "--to: no way leads from 3 2 to -1 -1, which lies outside of the plan (x 0 to 6, y 0 to 4 m)");
  refused({"--robot", "one", "--method", "grid", "--step", "0.01", "--room", "50"},
          "world.xml: the lattice has more than a million places; expected a larger step or a smaller area");
  refused({"--radius", "0.2"}, "empty.xml: there is neither a wall nor a robot: no area to plan in", "empty.xml");
}

// Goals are only looked at for a warning: a file that no controller could read was an error of the roadmap.
TEST(RoadmapVerb, GoalsThatCannotBeReadAreLeftToTheRun) {
  const ProgramFolder folder;
  folder.write("goals.csv", "a,b\n1,1\n");
  folder.write("world.xml", world_of(box + rover + "<control.navigate robot=\"rover\" goals=\"goals.csv\"/>"));
  const std::vector<std::string> words = {"--radius", "0.5", "--margin", "0", "--room", "5"};
  EXPECT_EQ(figures(folder, words)["nodes"], 4);
  std::filesystem::remove(folder / "goals.csv");
  EXPECT_EQ(figures(folder, words)["nodes"], 4);
}

}  // namespace
}  // namespace muster::test
