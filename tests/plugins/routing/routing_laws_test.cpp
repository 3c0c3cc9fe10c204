// Laws of each routing alone: floods that end, tables that are followed, routes that are found and found again.
#include <cmath>

#include "routing_worlds.hpp"

namespace muster {
namespace {

class Flooding : public Routings, public testing::WithParamInterface<std::string> {};

TEST_P(Flooding, EachRadioOfAChainSendsOnce) {
  for (const int radios : {2, 3, 6, 9}) {
    const std::string last = "r" + std::to_string(radios - 1);
    Simulation sim =
        world(GetParam(), "routing.flooding", chain(radios) + send("s", "r0", "to=\"" + last + "\" only=\"1\""));
    run(sim, 60);
    EXPECT_EQ(journeys(sim, "r0", "delivered"), 1);
    EXPECT_EQ(sum_of(sim, "radio/*/relaying", own), 1);
    EXPECT_EQ(sum_of(sim, "radio/*/relaying", relayed), radios - 2);  // all but both ends
    EXPECT_EQ(sum_of(sim, "radio/*/relaying", control), 0);
  }
}

TEST_P(Flooding, ABroadcastReachesAllAndEachSaysItOnce) {
  Simulation sim = world(GetParam(), "routing.flooding", chain(6) + send("s", "r2", "only=\"1\""));
  std::size_t came = 0;
  for (int tick = 0; tick < 60; ++tick) sim.step(), came += arrived(sim);
  EXPECT_EQ(came, 5u);
  EXPECT_EQ(journeys(sim, "r2", "delivered"), 5);
  EXPECT_EQ(sum_of(sim, "radio/*/relaying", relayed), 5);
}

TEST_P(Flooding, TtlLimitsTheHops) {
  for (const int ttl : {1, 3, 4, 5}) {
    Simulation sim = world(GetParam(), "routing.flooding ttl=\"" + std::to_string(ttl) + "\"",
                           chain(6) + send("s", "r0", "to=\"r4\" only=\"1\""));
    run(sim, 60);
    EXPECT_EQ(journeys(sim, "r0", "delivered"), ttl >= 4);
    EXPECT_EQ(journeys(sim, "r0", "ttl_expired"), ttl < 4);
    EXPECT_EQ(sum_of(sim, "radio/*/relaying", relayed), std::min(ttl, 4) - 1);
  }
}

// In a clique every radio receives every copy and repeats it once.
TEST_P(Flooding, ManyCopiesAreOneMessage) {
  std::string clique;
  for (int i = 0; i < 6; ++i) clique += station("r" + std::to_string(i), std::to_string(i) + " 0 1");
  Simulation sim = world(GetParam(), "routing.flooding", clique + send("s", "r0", "only=\"1\""));
  std::size_t came = 0;
  for (int tick = 0; tick < 60; ++tick) sim.step(), came += arrived(sim);
  EXPECT_EQ(came, 5u);
  EXPECT_EQ(sum_of(sim, "radio/*/relaying", relayed), 5);
}
INSTANTIATE_TEST_SUITE_P(Networks, Flooding, testing::Values("network.ideal", "network.lrwpan", "network.wifi"));

using Static = Routings;

TEST_F(Static, GoesTheWayOfTheTableThoughAShorterOneIsThere) {
  folder.put("routes.csv", "at,to,next\na,d,b\nb,,c\nc,d,d\n");
  Simulation sim = world("network.ideal", "routing.static routes=\"routes.csv\"",
                         station("a", "0 0 1") + station("b", "5 0 1") + station("c", "5 5 1") + station("d", "0 5 1") +
                             send("s", "a", "to=\"d\" only=\"1\""));
  run(sim, 5);
  const TableView relaying = sim.table("radio/*/relaying");
  EXPECT_EQ(journeys(sim, "a", "delivered"), 1);
  for (const std::size_t radio : {1u, 2u}) EXPECT_EQ(relaying.at(radio, relayed), 1);
}

TEST_F(Static, WhoHasNoRowHasNoRoute) {
  folder.put("routes.csv", "at,to,next\nr0,r2,r1\n");
  Simulation sim = world("network.ideal", "routing.static routes=\"routes.csv\"",
                         chain(3) + send("s", "r0", "to=\"r2\" only=\"1\"") + send("t", "r2", "to=\"r0\" only=\"1\""));
  run(sim, 10);
  EXPECT_EQ(journeys(sim, "r0", "no_route"), 1);  // r1 has no route on
  EXPECT_EQ(journeys(sim, "r2", "no_route"), 1);
  EXPECT_EQ(sim.table("radio/r0/relaying").at(0, own), 1);
  EXPECT_EQ(sim.table("radio/r2/relaying").at(0, own), 0);
}

TEST_F(Static, ATableThatGoesRoundEndsWithTheTimeToLive) {
  folder.put("routes.csv", "at,to,next\nr0,r3,r1\nr1,r3,r2\nr2,r3,r1\n");
  Simulation sim = world("network.ideal", "routing.static routes=\"routes.csv\" ttl=\"8\"",
                         chain(4) + send("s", "r0", "to=\"r3\" only=\"1\""));
  run(sim, 30);
  EXPECT_EQ(journeys(sim, "r0", "ttl_expired"), 1);
  EXPECT_EQ(sum_of(sim, "radio/*/relaying", relayed), 7);
}

TEST_F(Static, LoopsAndWaysThatEndAreWarnedOf) {
  const auto warnings = [&](const std::string& rows) {
    folder.put("routes.csv", "at,to,next\n" + rows);
    Simulation sim = world("network.ideal", "routing.static routes=\"routes.csv\"", chain(4) + send("s", "r0"));
    sim.step();
    std::string result;
    for (const auto& event : sim.events())
      if (const auto at = event.message.find("routes.csv:"); at != std::string::npos)
        result += event.message.substr(at) + '\n';
    return result;
  };
  EXPECT_EQ(warnings("r0,r2,r1\nr1,r2,r2\nr2,r0,r1\nr1,r0,r0\n"), "");
  EXPECT_EQ(warnings("r0,r2,r1\nr1,r2,r0\n"),
            "routes.csv:3:1: messages for \"r2\" go r0, r1, r0: a loop, in which each ends as ttl_expired; expected "
            "r1,r2,NEXT with another NEXT than r0, such as r2 itself\n");
  EXPECT_EQ(warnings("r0,r3,r1\nr1,r3,r2\nr2,r3,r1\n"),
            "routes.csv:4:1: messages for \"r3\" go r1, r2, r1: a loop, in which each ends as ttl_expired; expected "
            "r2,r3,NEXT with another NEXT than r1, such as r3 itself\n");
  EXPECT_EQ(warnings("r0,r2,r1\n"),
            "routes.csv:2:1: messages for \"r2\" go r0, r1, which has no row for it, so that each ends there as "
            "no_route; expected a row r1,r2,NEXT\n");
}

TEST_F(Static, RefusesATableThatCannotBe) {
  const auto error = [&](const std::string& rows, const std::string& header = "at,to,next\n") {
    folder.put("routes.csv", header + rows);
    try {
      Simulation sim = world("network.ideal", "routing.static routes=\"routes.csv\"", chain(3) + send("s", "r0"));
      sim.step();
    } catch (const Error& refused) {
      return std::string(refused.what());
    }
    return std::string("no error");
  };
  using testing::HasSubstr;
  EXPECT_THAT(error("r0,r2,r0\n"), HasSubstr("routes.csv:2:1: r0 sends to itself; expected another radio as next"));
  EXPECT_THAT(error("r0,r2,r1\nr2,r2,r1\n"),
              HasSubstr("routes.csv:3:1: r2 is where the message is for; expected a radio "
                        "that still has to send it"));
  EXPECT_THAT(error("r0,r2,r1\nr0,r2,r2\n"),
              HasSubstr("routes.csv:3:1: r0 has a row for r2 already, by r1; expected one row, by r1 or by r2"));
  EXPECT_THAT(error("r0,,r1\nr0,,r2\n"), HasSubstr("routes.csv:3:1: r0 has a row for all others already, by "));
  EXPECT_THAT(error("r0,r9,r1\n"), HasSubstr("routes.csv:2"));
  EXPECT_THAT(error("r0,r2,r1\n", "at,too,next\n"),
              HasSubstr("routes.csv:1:4: column \"too\" means nothing here; expected one of at, to, next; did you mean "
                        "\"to\"?"));
}

using AodvWorlds = Routings;

TEST_F(AodvWorlds, FindsTheShortestWayOnAGrid) {
  std::string grid;
  for (int i = 0; i < 25; ++i)
    grid += station("r" + std::to_string(i), std::to_string(10 * (i % 5)) + ' ' + std::to_string(10 * (i / 5)) + " 1");
  Simulation sim = world("network.ideal", "routing.aodv", grid + send("s", "r0", "to=\"r24\" only=\"1\""), 1, "0.01");
  run(sim, 700);
  EXPECT_EQ(journeys(sim, "r0", "delivered"), 1);
  EXPECT_EQ(sum_of(sim, "radio/*/relaying", relayed), 7);  // of 8 hops
}

// A ring: the other way round remains when a radio of the first one leaves.
TEST_F(AodvWorlds, FindsAnotherWayWhenARadioLeaves) {
  for (const std::string network : {"network.ideal", "network.lrwpan", "network.wifi"}) {
    std::string ring;
    for (int i = 0; i < 6; ++i)
      ring += station("r" + std::to_string(i), std::to_string(10 * std::cos(i * M_PI / 3)) + ' ' +
                                                   std::to_string(10 * std::sin(i * M_PI / 3)) + " 1");
    Simulation sim =
        world(network, "routing.aodv", ring + send("s", "r0", "to=\"r2\"") + "<test.leaver radio=\"r1\" at=\"100\"/>");
    run(sim, 100);
    const double before = journeys(sim, "r0", "delivered");
    EXPECT_GE(before, 80);
    EXPECT_EQ(sim.table("radio/r4/relaying").at(0, relayed), 0);
    run(sim, 200);
    EXPECT_GE(journeys(sim, "r0", "delivered"), before + 150) << network;
    EXPECT_GE(sim.table("radio/r4/relaying").at(0, relayed), 150) << network;
  }
}

TEST_F(AodvWorlds, WhoIsOutOfReachHasNoRoute) {
  Simulation sim = world("network.ideal", "routing.aodv", six + send("s", "r0", "to=\"r5\" only=\"1\""), 1, "0.02");
  run(sim, 2000);
  EXPECT_EQ(journeys(sim, "r0", "no_route"), 1);
}

}  // namespace
}  // namespace muster
