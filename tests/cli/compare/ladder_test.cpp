// The fidelity ladder: what each rung's channel is, in closed form, and that the last one is the world as it was given.
#include "compared.hpp"

namespace muster::test {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;

// Two radios 10 m apart, a wall of 7.5 dB between them, and one that calls.
std::string calling_world(const std::string& more = "") {
  return "<world name=\"call\" dt=\"0.1\" until=\"2\" seed=\"3\"><material name=\"brick\" loss=\"7.5\"/>"
         "<wall name=\"w\" from=\"5 -9\" to=\"5 9\" height=\"3\" material=\"brick\"/>"
         "<station name=\"a\" at=\"0 0 1\"/><station name=\"b\" at=\"10 0 1\"/>"
         "<radio.multiwall tx_power=\"-10\" l0=\"40\" n=\"2\" radius=\"9\"/>" +
         more + "</world>";
}

std::vector<double> values(const nlohmann::json& told, std::size_t metric) {
  std::vector<double> result;
  for (const auto& rung : told["rungs"]) result.push_back(rung["metrics"][metric]["value"].get<double>());
  return result;
}

TEST(Ladder, TakesAwayWhatMakesAChannelHard) {
  const CompareFolder folder;
  folder.write("world.xml", calling_world("<network.ideal/><control.beacon radio=\"a\"/>"));
  const auto told = folder.json({"--ladder", "world.xml", "--metric", "link/*/level/level", "--metric",
                                 "link/*/level@radio.multiwall.walls/level"});
  std::vector<std::string> names;
  for (const auto& rung : told["rungs"]) names.push_back(rung["rung"]);
  EXPECT_THAT(names,
              ElementsAre("perfect", "disc", "log_distance", "multi_wall", "+ shadowing", "+ fading", "+ contention"));
  const auto level = values(told, 0), walls = values(told, 1);
  ASSERT_EQ(level.size(), 7u);
  EXPECT_THAT(std::vector(level.begin(), level.begin() + 4),
              ElementsAre(-50, -250, DoubleNear(-70, 1e-9), DoubleNear(-77.5, 1e-9)));
  EXPECT_NE(level[4], level[3]);
  EXPECT_EQ(level[5], level[4]);  // fading is no part of the level
  EXPECT_EQ(level[6], level[4]);
  EXPECT_THAT(walls, ElementsAre(0, 0, 0, -7.5, -7.5, -7.5, -7.5));
}

// It was set after the rung's own, and undid them: the lower rungs had the shadowing.
TEST(Ladder, WhatIsSetHoldsOnTheRungsThatHaveIt) {
  const CompareFolder folder;
  folder.write("world.xml", calling_world("<radio.fading shadowing=\"6\"/>"));
  const auto told =
      folder.json({"--ladder", "world.xml", "--metric", "link/*/level/level", "--set", "radio.fading/shadowing=3",
                   "--set", "radio.multiwall/n=3", "--set", "material/brick/loss=5"});
  const auto level = values(told, 0);
  ASSERT_EQ(level.size(), 6u);
  EXPECT_THAT(std::vector(level.begin(), level.begin() + 4),
              ElementsAre(-50, -250, DoubleNear(-80, 1e-9), DoubleNear(-85, 1e-9)));
  EXPECT_NE(level[4], level[3]);
}

TEST(Ladder, ShowsMessagesAndMovesWhereNothingElseIsAskedFor) {
  const CompareFolder folder;
  folder.write("way.csv", "x[m],y[m]\n100,0\n");
  folder.write(
      "world.xml",
      calling_world(
          "<network.ideal/><control.beacon radio=\"a\"/><robot name=\"r\" at=\"0 3 0\"/><physics.planar name=\"p\"/>"
          "<control.waypoint robot=\"r\" path=\"way.csv\" speed=\"0.3\"/>"));
  const auto told = folder.json({"--ladder", "world.xml", "--out", "out"});
  EXPECT_EQ(told["rungs"][0]["metrics"][0]["name"], "moved");
  EXPECT_EQ(told["rungs"][0]["metrics"][1]["name"], "delivered");
  EXPECT_EQ(values(told, 1)[0], 1);    // perfect
  EXPECT_LT(values(told, 1)[1], 1);    // b is beyond the disc
  EXPECT_GT(values(told, 0)[0], 0.4);  // m, in 2 s
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "out" / "ladder.svg"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "out" / "ladder.csv"));
}

TEST(Ladder, EndsWithTheWorldAsItIsGiven) {
  const CompareFolder folder;
  folder.write("world.xml", calling_world("<radio.fading shadowing=\"6\" rician_k=\"3\" per_reading=\"true\"/>"
                                          "<network.lrwpan noise=\"-100\"/><control.beacon radio=\"a\"/>"));
  const auto told = folder.json({"--ladder", "world.xml"});
  const auto run = folder.muster({"run", "world.xml", "--json"});
  ASSERT_EQ(run.exit, 0) << run.err;
  EXPECT_EQ(told["rungs"].back()["digest"], nlohmann::json::parse(run.out)["digest"]);
  std::set<std::string> digests;
  for (const auto& rung : told["rungs"]) digests.insert(rung["digest"].get<std::string>());
  EXPECT_EQ(digests.size(), told["rungs"].size()) << "each rung is another channel";
}

// What takes the place of radio.fading, in whole or in part, under whatever name.
TEST(Ladder, KnowsWhatShadowsAndFadesByWhatItSaysOfItself) {
  for (const std::string terms : {"<radio.ar1 name=\"chance\" shadowing=\"6\"/>",
                                  "<radio.gudmundson name=\"g\" shadowing=\"6\"/><radio.fading shadowing=\"0\"/>"}) {
    const CompareFolder folder;
    folder.write("world.xml", calling_world(terms));
    const auto told =
        folder.json({"--ladder", "world.xml", "--metric", "link/*/level/level", "--metric", "link/*/fading/gain"});
    const auto level = values(told, 0), gain = values(told, 1);
    ASSERT_EQ(level.size(), 6u) << terms;
    EXPECT_NEAR(level[3], -77.5, 1e-9) << terms;
    EXPECT_GT(std::abs(level[4] - level[3]), 1e-3) << terms;
    EXPECT_THAT(std::vector(gain.begin(), gain.end() - 1), testing::Each(1)) << terms;
    const auto run = folder.muster({"run", "world.xml", "--json"});
    ASSERT_EQ(run.exit, 0) << run.err;
    EXPECT_EQ(told["rungs"].back()["digest"], nlohmann::json::parse(run.out)["digest"]) << terms;
  }
}

TEST(Ladder, AddsFadingWhereShadowingIsAllThatTheWorldHas) {
  const CompareFolder folder;
  folder.write("world.xml", calling_world("<radio.gudmundson shadowing=\"6\"/>"));
  const auto told = folder.json({"--ladder", "world.xml", "--metric", "link/*/level/level"});
  const auto level = values(told, 0);
  EXPECT_EQ(told["rungs"][4]["made_by"], "radio.gudmundson shadowing");
  EXPECT_EQ(told["rungs"][5]["made_by"], "radio.fading fading=\"true\"");
  EXPECT_NE(level[4], level[3]);
  EXPECT_EQ(level[5], level[4]) << "nothing shadows twice";
  EXPECT_NE(told["rungs"][5]["digest"], told["rungs"][4]["digest"]);
}

TEST(Ladder, LeavesOtherTermsOutUntilTheirRung) {
  const CompareFolder folder;
  folder.write("world.xml", calling_world("<radio.antenna name=\"mast\"/>"));
  const auto told = folder.json({"--ladder", "world.xml", "--metric", "link/*/level/level"});
  const auto level = values(told, 0);
  ASSERT_EQ(level.size(), 7u);
  EXPECT_EQ(level[0], -50);
  EXPECT_NEAR(level[3], -77.5, 1e-9);
  EXPECT_EQ(told["rungs"][4]["rung"], "+ other terms");
  EXPECT_EQ(told["rungs"][4]["made_by"], "radio.antenna");
  EXPECT_NEAR(level[4], -77.5 + 2 * 2.15, 0.01);  // broadside, at both ends
}

TEST(Ladder, HasNoContentionWhereNobodyTalks) {
  const CompareFolder folder;
  folder.write("world.xml", calling_world());
  const auto told = folder.json({"--ladder", "world.xml", "--metric", "link/*/level/level"});
  EXPECT_EQ(told["rungs"].size(), 6u);
  EXPECT_EQ(told["rungs"].back()["rung"], "+ fading");
}

TEST(Ladder, RefusesWhatItCannotClimb) {
  const CompareFolder folder;
  folder.write("world.xml", calling_world());
  folder.write("way.csv", "x[m],y[m]\n100,0\n");
  folder.write("drive.xml", drive_world());
  folder.write("bare.xml", "<world name=\"bare\" dt=\"0.1\" until=\"1\"><station name=\"a\" at=\"0 0 1\"/></world>");
  const std::pair<std::vector<std::string>, std::string> cases[] = {
      {{"--ladder", "bare.xml"},
       "muster compare --ladder: the world has neither a radio.multiwall, whose model the first rungs set, nor a "
       "physics, "
       "which the others exchange"},
      {{"world.xml", "drive.xml", "--measured", "way.csv"},
       "muster compare: --measured has no effect without --ladder; expected --ladder beside it, or no --measured; see "
       "muster compare --help"},
      {{"--ladder", "world.xml"},
       "muster compare --ladder: the world has neither robots nor messages; expected --metric TABLE/COLUMN"},
      {{"--ladder", "world.xml", "drive.xml"},
       "muster compare --ladder: takes the world alone, as its rungs are what is compared; expected no drive.xml"},
      {{"--ladder", "world.xml", "--within", "pose/distance=1"},
       "muster compare --ladder: takes the world alone, as its rungs are what is compared; expected no --within"},
      {{"drive.xml", "world.xml", "--metric", "x"},
       "muster compare: --metric has no effect without --ladder; expected --ladder beside it, or no --metric; see "
       "muster compare --help"},
      {{"--ladder", "world.xml", "--metric", "x"},
       "--metric \"x\": expected TABLE/COLUMN, such as robot/leader/pose/x"},
      {{"--ladder", "world.xml", "--metric", "link/*/level/lvel"},
       "--metric: \"link/*/level\" has no column \"lvel\"; expected level; did you mean \"level\"?"}};
  for (const auto& [words, message] : cases) {
    std::vector<std::string> all = {"compare"};
    all.insert(all.end(), words.begin(), words.end());
    expect_error(folder.muster(all), 2, message);
  }
}

std::vector<std::string> bodies(const nlohmann::json& told) {
  std::vector<std::string> result;
  for (const auto& body : told["bodies"]) result.push_back(body["rung"]);
  return result;
}

// Away from limits all bodies go the same way; the replayed one goes where its log says, whatever is commanded.
TEST(LadderOfBodies, GoesFromKinematicToMeasured) {
  const CompareFolder folder;
  folder.write("world.xml", drive_world());
  folder.write("log.csv", "t[s],robot,x[m],y[m],yaw[rad]\n0,r,0,0,0\n4,r,3,0,0\n");
  const auto told = folder.json({"--ladder", "world.xml", "--measured", "log.csv", "--metric", "robot/r/pose/x"});
  EXPECT_THAT(told["rungs"], testing::IsEmpty()) << "it has no channel";
  EXPECT_THAT(bodies(told), ElementsAre("kinematic", "rolling", "slipping", "measured"));
  std::vector<double> x;
  for (const auto& body : told["bodies"]) x.push_back(body["metrics"][0]["value"]);
  EXPECT_THAT(x, ElementsAre(DoubleNear(1.2, 0.05), DoubleNear(x[0], 0.01), DoubleNear(x[0], 0.01), 3));
  EXPECT_NE(x[1], x[2]);
}

TEST(LadderOfBodies, SaysWhichBodyARobotCannotHave) {
  const CompareFolder folder;
  folder.write("world.xml",
               "<world name=\"air\" dt=\"0.02\" until=\"0.1\"><robot name=\"r\" model=\"hummingbird\" at=\"0 0 "
               "0.06\"/><physics.simbody name=\"physics\"/></world>");
  const auto told = folder.json({"--ladder", "world.xml", "--metric", "robot/r/pose/z"});
  EXPECT_THAT(bodies(told), testing::Contains("slipping"));
  EXPECT_EQ(told["bodies"].size() + told["left_out"].size(), 3u);
  EXPECT_THAT(told["left_out"], testing::Not(testing::IsEmpty()));
}

}  // namespace
}  // namespace muster::test
