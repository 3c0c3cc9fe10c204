// What a comparison is asked for, what it refuses, and how it ends.
#include "compared.hpp"

namespace muster::test {
namespace {

using testing::HasSubstr;

TEST(CompareWords, ToleranceDecidesTheExitCode) {
  const CompareFolder folder;
  folder.write("world.xml", drive_world());
  const std::vector<std::string> words = {"compare", "world.xml", "steer=control.waypoint:speed=0.4", "--within"};
  const auto with = [&](std::string tolerance) {
    auto all = words;
    all.push_back(std::move(tolerance));
    return folder.muster(all);
  };
  const auto wide = with("pose/distance=0.5"), narrow = with("pose/distance=0.2"),
             whole = with("robot/*/command/v=0.05");
  EXPECT_EQ(wide.exit, 0) << wide.err;
  EXPECT_THAT(wide.out, HasSubstr("  within 0.5 m\n"));
  EXPECT_EQ(narrow.exit, 1);
  // 0.1 t - 0.0175 passes 0.2 at 2.175 s.
  EXPECT_THAT(narrow.out, HasSubstr("  BEYOND 0.2 m from 2.2 s on\n"));
  EXPECT_EQ(whole.exit, 1);
  // Each tolerance is one word, so that runs may be named after it; the second is not met.
  const auto two = folder.muster({"compare", "world.xml", "--within", "pose/distance=0.5", "--within", "command/v=0.05",
                                  "steer=control.waypoint:speed=0.4"});
  EXPECT_EQ(two.exit, 1) << two.err;
  EXPECT_THAT(two.out, HasSubstr("  BEYOND 0.05 m/s from 0.05 s on\n"));
  const auto misspelt = with("pose/distnce=1");
  EXPECT_EQ(misspelt.exit, 2);
  EXPECT_THAT(misspelt.err, testing::StartsWith("muster: error: --within: both runs have no quantity \"pose/distnce\"; "
                                                "did you mean \"pose/distance\"? expected one of "));
  EXPECT_EQ(misspelt.out, "");
}

// It was only told that one run alone has the robot, with exit code 0.
TEST(CompareWords, ARobotOfOneRunAloneIsWithinNoTolerance) {
  const CompareFolder folder;
  const std::string head = "<world dt=\"0.1\" until=\"1\"><robot name=\"r\" at=\"0 0 0\"/>";
  folder.write("one.xml", head + "<physics.planar/></world>");
  folder.write("more.xml", head + "<robot name=\"t\" at=\"0 9 0\"/><physics.planar/></world>");
  const auto outcome = folder.muster({"compare", "one.xml", "more.xml", "--within", "pose/distance=0.05"});
  EXPECT_EQ(outcome.exit, 1) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("  BEYOND 0.05 m from 0 s on\n"));
  EXPECT_EQ(folder.muster({"compare", "one.xml", "more.xml"}).exit, 0);
}

TEST(CompareWords, AreRefusedWithTheNearestName) {
  const CompareFolder folder;
  folder.write("world.xml", drive_world());
  folder.write("coarse.xml", "<world dt=\"0.1\" until=\"4\"/>");
  const std::pair<std::vector<std::string>, std::string> cases[] = {
      {{}, "muster compare: there is nothing to compare with; expected INSTANCE=PLUGIN or a second world"},
      {{"physisc=physics.simbody"},
       "muster compare: no instance is called \"physisc\"; expected one of physics, steer, robots.drive, "
       "robots.odometry; did you mean \"physics\"?"},
      {{"physics="}, "muster compare: \"physics=\" is neither a world nor INSTANCE=PLUGIN[:NAME=VALUE...]"},
      {{"physics=physics.planar:acceleration"},
       "muster compare: \"acceleration\" is no attribute; expected NAME=VALUE"},
      {{"physics=physics.planar:name=p"},
       "muster compare: the attribute \"name\" cannot be given; the new plugin keeps the name \"physics\""},
      {{"physics=physics.planar:aceleration=1"},
       "muster compare: <physics.planar> has no attribute \"aceleration\"; expected one of name, every, library, "
       "revision, acceleration, through_walls; did you mean \"acceleration\"?"},
      {{"physics.planar"},
       "muster compare: \"physics.planar\" is no world; expected INSTANCE=PLUGIN, such as physics=physics.planar"},
      {{"steer"}, "muster compare: \"steer\" is no world; expected steer=PLUGIN, the plugin that takes its place"},
      {{"physics=physics.planar", "acceleration=1"},
       "muster compare: no instance is called \"acceleration\"; did you mean physics=physics.planar:acceleration=1? "
       "attributes follow their plugin behind a colon"},
      {{"physics=physics.planar,acceleration=4"},
       "muster compare: \"physics.planar,acceleration=4\" is no plugin; did you mean "
       "physics=physics.planar:acceleration=4? attributes follow their plugin behind a colon"},
      {{"physics=physics.planar:acceleration:4"},
       "muster compare: \"acceleration\" is no attribute; expected NAME=VALUE; did you mean acceleration=4?"},
      {{"coarse.xml"},
       "coarse.xml: ticks of 0.1 s against 0.05 s, so that no tick has one beside it; expected dt=\"0.05\" in both "
       "worlds"},
      {{"absent.xml"}, "absent.xml: no such file"}};
  for (const auto& [words, message] : cases) {
    std::vector<std::string> all = {"compare", "world.xml"};
    all.insert(all.end(), words.begin(), words.end());
    expect_error(folder.muster(all), 2, message);
  }
}

TEST(CompareWords, AnInstanceOfItsOwnPluginKeepsWhatIsNotGiven) {
  const CompareFolder folder;
  folder.write("world.xml", drive_world());
  // Without the path of the world's file the controller could not be made.
  EXPECT_EQ(folder.json({"world.xml", "steer=control.waypoint"})["comparisons"][0]["same"], true);
}

// Of the three runs one cannot be made; the other two are compared.
TEST(CompareWords, WhatCannotBeRunIsToldAndTheOthersGoOn) {
  const CompareFolder folder;
  folder.write("world.xml", drive_world());
  const auto outcome = folder.muster({"compare", "world.xml", "physics=physics.plana", "physics=physics.simbody"});
  EXPECT_EQ(outcome.exit, 3) << "as for any plugin that is not found";
  EXPECT_THAT(outcome.out, HasSubstr("  not run: physics=physics.plana\n"));
  EXPECT_THAT(outcome.out, HasSubstr("B against A, to t = 4 s\n"));
  const std::string why = "muster compare: plugin \"physics.plana\": physics_plana.so not found; looked in ";
  EXPECT_THAT(outcome.err, testing::StartsWith("muster: note: physics=physics.plana cannot be run: " + why));
  EXPECT_THAT(outcome.err, testing::EndsWith("did you mean \"physics.planar\"?\n"
                                             "muster: error: physics=physics.plana could not be run\n"));
  const auto alone = folder.muster({"compare", "world.xml", "physics=physics.plana"});
  EXPECT_EQ(alone.exit, 3);
  EXPECT_EQ(alone.out, "") << "there is nothing to compare";
  EXPECT_THAT(alone.err, testing::StartsWith("muster: error: " + why));
}

TEST(CompareWords, ARunThatFailsEndsAndTheOtherIsReported) {
  const CompareFolder folder;
  folder.write("world.xml", "<world name=\"w\" dt=\"0.1\" until=\"1\"><test.good name=\"toy\"/></world>");
  const auto outcome =
      folder.muster({"compare", "world.xml", "toy=test.throws_in_step", "--plugins", MUSTER_TOYS, "--json"});
  EXPECT_EQ(outcome.exit, 3);
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json["runs"][0]["ticks"], 10);
  EXPECT_EQ(json["runs"][0]["error"], nullptr);
  EXPECT_EQ(json["runs"][1]["ticks"], 4);
  EXPECT_THAT(json["runs"][1]["error"].get<std::string>(), HasSubstr("the shelf is empty"));
  EXPECT_EQ(json["comparisons"][0]["ticks"], 4);
  EXPECT_EQ(json["comparisons"][0]["same"], true) << "as far as both went";
  EXPECT_THAT(outcome.err, HasSubstr("the shelf is empty"));
}

// Two plugins may each keep a table of one name, with columns of their own; it ended in a segmentation fault.
TEST(CompareWords, TablesOfOneNameWithoutACommonColumnHaveOnlyColumnsOfTheirOwn) {
  const CompareFolder folder;
  folder.write("world.xml", "<world name=\"w\" dt=\"0.1\" until=\"1\"><test.good name=\"toy\"/></world>");
  const auto one = folder.json({"world.xml", "toy=test.other_column", "--plugins", MUSTER_TOYS})["comparisons"][0];
  EXPECT_EQ(one["ticks"], 10);
  EXPECT_EQ(one["only"]["A"], nlohmann::json::array({"instance/toy/*/cell value[m]"}));
  EXPECT_EQ(one["only"]["B"], nlohmann::json::array({"instance/toy/*/cell width[m]"}));
}

TEST(CompareWords, AWorldThatEndsEarlierIsComparedToItsEnd) {
  const CompareFolder folder;
  folder.write("short.xml", "<world dt=\"0.1\" until=\"1\"><robot name=\"r\" at=\"0 0 0\"/><physics.planar/></world>");
  folder.write("long.xml", "<world dt=\"0.1\" until=\"3\"><robot name=\"r\" at=\"0 0 0\"/><physics.planar/></world>");
  const auto json = folder.json({"short.xml", "long.xml"});
  EXPECT_EQ(json["comparisons"][0]["ticks"], 10);
  EXPECT_EQ(json["comparisons"][0]["same"], true);
  EXPECT_EQ(json["runs"][1]["ticks"], 30);
}

}  // namespace
}  // namespace muster::test
