// Row 28 of the requirements: robots that move into a link and out of it.
#include <cmath>

#include "world_of.hpp"

namespace muster {
namespace {

// test.mover drives robot i along y = i, from x = 1 m to 4 m and back in 20 ticks, its origin 0.2 m above ground.
const std::string robots = "<robot name=\"r0\" at=\"1 0 0\"/><robot name=\"r1\" at=\"1 1 0\"/><test.mover/>\n";
const std::string channel =
    "<radio.multiwall n=\"2\"/><radio.bodies name=\"bodies\" loss=\"7\" radius=\"0.2\" height=\"0.5\"/>\n";

double robot_x(int tick) { return 1 + 0.3 * std::min(tick % 20, 20 - tick % 20); }

TEST(Bodies, BlockALinkInTheTicksInWhichTheyStandInIt) {
  const Folder folder;
  Simulation sim = world_of(folder, station("a", "2.5 -5 0.4") + station("b", "2.5 5 0.4") + robots + channel);
  const double open = -40 - 20 * std::log10(10.0);
  int blocked = 0;
  for (int tick = 1; tick <= 60; ++tick) {
    sim.step();
    const bool in_the_way = std::abs(robot_x(tick) - 2.5) < 0.2;
    blocked += in_the_way;
    EXPECT_NEAR(by_pair(sim, "link/*/level").at({"a", "b"}), open - (in_the_way ? 2 * 7 : 0), 1e-9) << tick;
    EXPECT_TRUE(same_bits(by_pair(sim, "link/*/level").at({"a", "b"}), by_pair(sim, "link/*/level").at({"b", "a"})));
  }
  EXPECT_EQ(blocked, 6);
}

TEST(Bodies, AreOverlookedAndLookedUnder) {
  const Folder folder;
  for (const auto& [height, count] : std::map<std::string, int>{{"0.1", 0}, {"0.3", 2}, {"0.69", 2}, {"0.71", 0}}) {
    Simulation sim =
        world_of(folder, station("a", "2.5 -5 " + height) + station("b", "2.5 5 " + height) + robots + channel);
    run(sim, 5);
    EXPECT_EQ(by_pair(sim, "link/*/level@bodies").at({"a", "b"}), -7.0 * count) << height;
  }
}

// Only the height at the point nearest in plan counted, and upright links met nobody. A robot is 0.2 m to 0.7 m high.
TEST(Bodies, BlockSteepAndUprightLinks) {
  const Folder folder;
  const auto count = [&](const std::string& a, const std::string& b) {
    Simulation sim = world_of(folder, station("a", a) + station("b", b) + robots + channel);
    run(sim, 5);
    return by_pair(sim, "link/*/level@bodies").at({"a", "b"}) / -7;
  };
  EXPECT_EQ(count("2.65 0 0.3", "2.35 0 2"), 1) << "1.15 m high in its middle";
  EXPECT_EQ(count("2.65 0 0.8", "2.35 0 2"), 0) << "above it";
  EXPECT_EQ(count("2.5 0.1 0.3", "2.5 0.1 2"), 1) << "upright";
  EXPECT_EQ(count("2.5 0.1 0.8", "2.5 0.1 2"), 0) << "upright, above it";
  EXPECT_EQ(count("2.5 0.3 0.3", "2.5 0.3 2"), 0) << "upright, beside it";
}

TEST(Bodies, DoNotStandInTheirOwnWayNorBeyondAnEnd) {
  const Folder folder;
  Simulation sim = world_of(folder, station("a", "2.5 -5 0.4") + station("near", "2.5 0.5 0.4") + robots + channel);
  run(sim, 5);
  const auto term = by_pair(sim, "link/*/level@bodies");
  EXPECT_EQ(term.at({"a", "r0"}), 0);
  EXPECT_EQ(term.at({"a", "r1"}), -7);  // r0 is between
  EXPECT_EQ(term.at({"a", "near"}), -7);
  EXPECT_EQ(term.at({"near", "r1"}), 0);
}

}  // namespace
}  // namespace muster
