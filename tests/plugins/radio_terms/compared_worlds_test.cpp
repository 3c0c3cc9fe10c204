// Channels of other simulators in running worlds: in place of radio.fading, saved and restored, on several threads.
#include <algorithm>
#include <cmath>

#include "tests/plugins/radio/world_of.hpp"

namespace muster {
namespace {

const std::string team = [] {
  std::string result = station("base", "9 4 1");
  for (int i = 0; i < 4; ++i) result += "<robot name=\"r" + std::to_string(i) + "\" at=\"0 0 0\"/>\n";
  return result + "<test.tumbler/><radio.multiwall/><radio.receiver sensitivity=\"-250\"/>\n";
}();

const std::string channels[] = {"<radio.gudmundson/><radio.fading shadowing=\"0\"/>", "<radio.ar1/>",
                                "<radio.ar1 rician_k=\"6\"/>"};

TEST(ComparedWorld, DoesNotDependOnThreadsOrOnTheOrderOfRows) {
  for (const auto& channel : channels) {
    const Folder folder;
    Simulation one = world_of(folder, team + channel), many = world_of(folder, team + channel, 3);
    run(one, 12), run(many, 12);
    EXPECT_EQ(one.digest(), many.digest()) << channel;
    // Robots move by their rows: so the stations' order is reversed.
    const std::string more = station("a", "1 2 3"), and_more = station("b", "-4 2 1");
    Simulation first = world_of(folder, more + and_more + team + channel);
    Simulation second = world_of(folder, and_more + team + more + channel);
    run(first, 12), run(second, 12);
    expect_same_bits(by_pair(first, "link/*/rssi"), by_pair(second, "link/*/rssi"));
  }
}

// In dB2, at its own size and distance, in either direction; and what it gives as expected is no draw.
TEST(ComparedWorld, GudmundsonDeclaresHowItsDrawsAreCorrelated) {
  const Folder folder;
  Simulation sim = world_of(folder, station("a", "1 2 3") + station("b", "-4 2 1") + station("c", "-3.5 1 1") +
                                        "<radio.links/><radio.gudmundson shadowing=\"3\" decorrelation=\"2.5\"/>");
  const auto& all = sim.instances();
  const auto drawing = std::find_if(all.begin(), all.end(), [](const auto& i) { return i->plugin().draw; });
  ASSERT_NE(drawing, all.end());
  const double ends[3][6] = {{1, 2, 3, -4, 2, 1}, {-3.5, 1, 1, 1, 2, 3}, {-4, 2, 1, 1, 2, 3}};
  const uint32_t one[] = {0, 0, 0}, other[] = {0, 1, 2};
  double out[3];
  (*drawing)->plugin().draw->covariance((*drawing)->params().data(), ends[0], one, other, 3, out);
  EXPECT_NEAR(out[0], 9, 1e-12);
  EXPECT_NEAR(out[2], 9, 1e-12);
  const auto field = [](double metres) { return std::exp(-metres / 2.5); };
  const double ab = std::sqrt(25 + 0 + 4), ca = std::sqrt(4.5 * 4.5 + 1 + 4), bc = std::sqrt(0.25 + 1 + 0);
  const double together = field(bc) + field(ca) * field(ab);
  EXPECT_NEAR(out[1], 9 * together / std::sqrt((1 + field(2 * ab)) * (1 + field(2 * ca))), 1e-12);
  for (const bool expected : {false, true}) {
    sim.evaluate(MUSTER_RADIO, expected);
    for (const auto& [pair, level] : by_pair(sim, "link/*/level")) EXPECT_EQ(level == 0, expected);
  }
}

TEST(ComparedWorld, GoesOnAsItWasAfterARestoreAndARemake) {
  for (const auto& channel : channels) {
    const Folder folder;
    Simulation straight = world_of(folder, team + channel), broken = world_of(folder, team + channel);
    run(straight, 15), run(broken, 6);
    const Snapshot then = broken.snapshot();
    run(broken, 5);
    broken.restore(then);
    for (const auto& instance : std::vector<std::string>{"radio.gudmundson", "radio.fading", "radio.ar1"}) {
      if (channel.find(instance) != channel.npos) broken.remake(instance);
    }
    run(broken, 9);
    EXPECT_EQ(straight.digest(), broken.digest()) << channel;
  }
}

TEST(ComparedWorld, TakesThePlaceOfFadingInMidRun) {
  const Folder folder;
  Simulation sim = world_of(folder, team +
                                        "<radio.fading name=\"fading\"/><swap at=\"0.5\" instance=\"fading\" "
                                        "plugin=\"radio.ar1\" shadowing=\"3\"/>");
  run(sim, 4);
  const auto before = by_pair(sim, "link/*/level@fading.shadowing");
  run(sim, 4);
  const auto after = by_pair(sim, "link/*/level@fading.shadowing");
  EXPECT_NE(before.at({"base", "r1"}), after.at({"base", "r1"}));
  EXPECT_TRUE(same_bits(after.at({"base", "r1"}), after.at({"r1", "base"})));
}

// Where robots are at rest nothing changes; where they return, one channel gives the same values.
TEST(ComparedWorld, RemembersPlacesOrForgetsThem) {
  const std::string way = station("base", "9 4 1") +
                          "<robot name=\"r\" at=\"0 0 0\"/><test.mover/><radio.multiwall/>"
                          "<radio.receiver sensitivity=\"-250\"/>";  // out and back in 20 ticks
  for (const bool remembers : {true, false}) {
    const Folder folder;
    Simulation sim = world_of(folder, way + (remembers ? "<radio.gudmundson name=\"c\"/>" : "<radio.ar1 name=\"c\"/>"));
    const std::string table = remembers ? "link/*/level@c" : "link/*/level@c.shadowing";
    run(sim, 3);
    const auto before = by_pair(sim, table);
    run(sim, 20);
    EXPECT_EQ(by_pair(sim, table) == before, remembers);
  }
}

TEST(ComparedWorld, ChangesAsSlowlyAsItDecorrelates) {
  const Folder folder;
  Simulation sim = world_of(folder, team + "<radio.ar1 name=\"c\" decorrelation=\"10000\"/>");  // paths are 4 m a tick
  run(sim, 1);
  for (int tick = 2; tick < 12; ++tick) {
    const auto before = by_pair(sim, "link/*/level@c.shadowing");
    run(sim, 1);
    for (const auto& [pair, level] : by_pair(sim, "link/*/level@c.shadowing")) {
      EXPECT_NEAR(level, before.at(pair), 4 * 4 * std::sqrt(2 * 8 / 1e4)) << tick;  // four standard deviations of 4 dB
      if (pair.first == "r1" || pair.second == "r1") {
        EXPECT_NE(level, before.at(pair));
      }
    }
  }
}

TEST(ComparedWorld, ExpectsNoShadowingAndTheMeanOfDecibels) {
  const Folder folder;
  Simulation sim = world_of(folder, team + "<radio.ar1/><radio.gudmundson/>");
  run(sim, 3);
  const auto drawn = by_pair(sim, "link/*/rssi");
  sim.evaluate(MUSTER_RADIO, true);
  for (const auto& [pair, gain] : by_pair(sim, "link/*/fading")) EXPECT_NEAR(10 * std::log10(gain), -2.5068, 1e-3);
  for (const auto& [pair, level] : by_pair(sim, "link/*/level@radio.gudmundson")) EXPECT_EQ(level, 0);
  for (const auto& [pair, level] : by_pair(sim, "link/*/level@radio.ar1.shadowing")) EXPECT_EQ(level, 0);
  sim.evaluate(MUSTER_RADIO, false);
  expect_same_bits(by_pair(sim, "link/*/rssi"), drawn);
}

}  // namespace
}  // namespace muster
