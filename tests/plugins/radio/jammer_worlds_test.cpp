// A jammer in the world: the channel carries its emission, and networks that share a channel receive it.
// tests/README.md lists the rows.
#include <gmock/gmock.h>

#include "world_of.hpp"

namespace muster {
namespace {

const std::string channel = "<radio.multiwall n=\"3\"/><radio.receiver sensitivity=\"-90\"/>";

std::string jammer(const std::string& radio, const std::string& attributes) {
  return "<radio.jammer name=\"" + radio + "_noise\" radio=\"" + radio + "\" " + attributes + "/>\n";
}

class EachJammedChannel : public testing::TestWithParam<std::string> {
 protected:
  std::string network() const { return "<" + GetParam() + "/>"; }
  // Copies received from a radio, of one request in each of 50 ticks.
  double delivered(const std::string& elements, const std::string& from = "a", const std::string& to = "b") const {
    Simulation sim =
        world_of(folder, elements + channel + network() + "<test.sender from=\"" + from + "\" to=\"" + to + "\"/>");
    run(sim, 50);
    return sim.table("radio/" + from + "/traffic").at(0, 1);
  }
  const Folder folder;
  const std::string three = station("a", "0 0 1") + station("b", "3 0 1") + station("jammer", "20 0 1");
};

TEST_P(EachJammedChannel, FeelsAJammer) {
  EXPECT_GE(delivered(three), 49);
  EXPECT_GE(delivered(three + jammer("jammer", "duty=\"0\" excess=\"60\"")), 49);
  EXPECT_EQ(delivered(three + jammer("jammer", "excess=\"60\"")), 0);
}

TEST_P(EachJammedChannel, WallsWeakenAJammer) {
  const std::string wall =
      "<material name=\"steel\" loss=\"80\"/><wall name=\"w\" from=\"10 -5\" to=\"10 5\" material=\"steel\"/>";
  EXPECT_GE(delivered(wall + three + jammer("jammer", "excess=\"60\"")), 49);
}

TEST_P(EachJammedChannel, InAnotherBandAJammerDoesNothing) {
  EXPECT_GE(delivered(three + jammer("jammer", "excess=\"60\" frequency=\"5.8e9\"")), 49);
}

// Two take turns, each for a second: together they jam all the time.
TEST_P(EachJammedChannel, SeveralJammersAddUp) {
  const std::string four = three + station("other", "20 1 1");
  const std::string first = jammer("jammer", "excess=\"60\" period=\"2\" duty=\"0.5\"");
  EXPECT_GT(delivered(four + first), 15);
  EXPECT_LT(delivered(four + first), 45);
  EXPECT_EQ(delivered(four + first + jammer("other", "excess=\"60\" period=\"2\" duty=\"0.5\" phase=\"1\"")), 0);
}

TEST_P(EachJammedChannel, WhoJamsHearsNothingMeanwhile) {
  EXPECT_EQ(delivered(three + jammer("jammer", "excess=\"-150\""), "a", "jammer"), 0);
  EXPECT_GE(delivered(three + jammer("jammer", "excess=\"-150\"")), 49);
}

// The robot goes from 1 m to 4 m and back every two seconds; it drowns the station's 1 m while it is near.
TEST_P(EachJammedChannel, ARobotCarriesAJammerAlong) {
  // A Bluetooth channel receives less of it, and no radio waits for its end.
  const std::string power = GetParam() == "network.bluetooth" ? "55" : "40";
  Simulation sim =
      world_of(folder, station("a", "-2 0 0.2") + station("b", "-4 0 0.2") +
                           "<robot name=\"r\" at=\"1 0 0\"/><test.mover/>" + jammer("r", "excess=\"" + power + "\"") +
                           "<radio.multiwall n=\"10\"/><radio.receiver sensitivity=\"-90\"/>" + network() +
                           "<test.sender from=\"a\" to=\"b\"/>");
  int near = 0, far = 0;
  for (int tick = 1; tick <= 80; ++tick) {
    sim.step();
    const int at = tick % 20;
    const auto arrived = static_cast<int>(sim.table("inbox/*/message").rows());
    if (at >= 9 && at <= 11) far += arrived;
    if (at >= 19 || at <= 1) near += arrived;
  }
  EXPECT_EQ(near, 0);
  EXPECT_GT(far, 8);
}

// The leader drives on only while its link to the base is good.
TEST_P(EachJammedChannel, Row08AJammerStopsAMissionThatNeedsToStayConnected) {
  folder.put("roadmap.csv", "x[m],y[m]\n1,0\n20,0\n");
  const auto reached = [&](const std::string& jammers) {
    Simulation sim = world_of(
        folder, station("base", "0 0 0.3") + station("jammer", "10 8 1") +
                    "<robot name=\"leader\" at=\"1 0 0\" antenna=\"0 0 0.3\"/><physics.planar/>" + channel + network() +
                    jammers + "<control.beacon radio=\"base\" period=\"0.2\"/>" +
                    "<control.connectivity robot=\"leader\" roadmap=\"roadmap.csv\" parent=\"base\" role=\"leader\"/>");
    run(sim, 300);
    return sim.table("robot/leader/pose").at(0, 0);
  };
  EXPECT_GT(reached(""), 3);
  EXPECT_NEAR(reached(jammer("jammer", "excess=\"60\"")), 1, 0.1);
}

// worlds/jammer, with its page's numbers.
TEST(WorldJammer, ItsLeaderGoesOutAndComesBack) {
  Options options;
  options.search_path = {MUSTER_PLUGINS_DIR};
  Simulation sim(read_world(MUSTER_SOURCE_DIR "/worlds/jammer", standard()), standard(), options);
  const auto leader_at = [&](double time) {
    while (sim.time() < time - 1e-9) sim.step();
    return sim.table("robot/leader/pose").at(0, 0);
  };
  EXPECT_NEAR(leader_at(40), 4.6, 0.1);
  EXPECT_EQ(sim.table("radio/base/traffic").at(0, 5), 0);
  EXPECT_NEAR(leader_at(80), 1, 0.01);
  EXPECT_GT(sim.table("radio/base/traffic").at(0, 5), 140);  // no access
  EXPECT_NEAR(leader_at(120), 4.6, 0.1);
}

std::vector<std::string> jammed_channels() {
  std::vector<std::string> result;
  for (const std::string name : {"bluetooth", "lrwpan", "wifi"})
    if (std::filesystem::exists(std::filesystem::path(MUSTER_PLUGINS_DIR) / ("network_" + name + ".so")))
      result.push_back("network." + name);
  return result;
}
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(EachJammedChannel);  // where no such plugin was built
INSTANTIATE_TEST_SUITE_P(Plugins, EachJammedChannel, testing::ValuesIn(jammed_channels()),
                         [](const auto& network) { return network.param.substr(8); });

}  // namespace
}  // namespace muster
