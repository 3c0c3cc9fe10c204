// What every routing keeps on every network, known by nothing but their files. Numbers are rows of the requirements
// (../shared/design/REQUIREMENTS.md).
#include <gmock/gmock.h>

#include <cmath>
#include <numeric>
#include <set>

#include "tests/plugins_radio/world_of.hpp"

namespace muster {
namespace {

// Columns of an inbox.
enum { to = 0, from = 1, rssi = 2, t_sent = 3, t_received = 4 };

// Radios hear each other up to 13 m.
const std::string channel =
    "<radio.links range=\"600\"/><radio.multiwall n=\"3\"/><radio.receiver sensitivity=\"-73.5\"/>";

std::string send(const std::string& name, const std::string& sender, const std::string& attributes = "") {
  return "<test.sender name=\"" + name + "\" from=\"" + sender + "\" " + attributes + "/>\n";
}

// Radios r0, r1, ... 10 m apart, of which each hears its neighbours only.
std::string chain(int radios) {
  std::string result;
  for (int i = 0; i < radios; ++i) result += station("r" + std::to_string(i), std::to_string(10 * i) + " 0 1");
  return result;
}

// Routes along that chain, in both directions.
std::string chain_routes(int radios) {
  std::string result = "at,to,next\n";
  const auto name = [](int i) { return 'r' + std::to_string(i); };
  for (int at = 0; at < radios; ++at) {
    for (int target = 0; target < at; ++target) result += name(at) + ',' + name(target) + ',' + name(at - 1) + '\n';
    if (at + 1 < radios) result += name(at) + ",," + name(at + 1) + '\n';
  }
  return result;
}

std::string payload(const Simulation& sim, std::size_t row) {
  const TableView inbox = sim.table("inbox/*/message");
  const auto blob = static_cast<std::size_t>(inbox.at(row, Incoming::payload_column));
  if (blob == 0) return "";
  const auto& bytes = *inbox.table->now().blobs[blob - 1];
  return {bytes.begin(), bytes.end()};
}

// What test.sender sends in a tick.
std::string sent(std::size_t size, uint64_t tick) {
  std::string result(size, '\0');
  for (std::size_t i = 0; i < size; ++i) result[i] = static_cast<char>(mixed(i + tick));
  return result;
}

// Messages that came in this tick.
std::size_t arrived(const Simulation& sim) {
  const Cells& cells = sim.table("inbox/*/message").table->now();
  return static_cast<std::size_t>(std::count(cells.appended.begin(), cells.appended.end(), sim.tick()));
}

const std::vector<std::string> outcomes{"delivered", "lost", "gone", "queue_full", "no_route", "ttl_expired"};

double journeys(const Simulation& sim, const std::string& radio, const std::string& column) {
  const auto found = std::find(outcomes.begin(), outcomes.end(), column) - outcomes.begin();
  const auto at = column == "asked" ? 0 : static_cast<std::size_t>(found) + 1;
  return sim.table("radio/" + radio + "/journeys").at(0, at);
}

double ended(const Simulation& sim, const std::string& radio) {
  double sum = 0;
  for (const auto& outcome : outcomes) sum += journeys(sim, radio, outcome);
  return sum;
}

double sum_of(const Simulation& sim, const std::string& table, std::size_t column) {
  const TableView view = sim.table(table);
  double sum = 0;
  for (std::size_t r = 0; r < view.rows(); ++r) sum += view.at(r, column);
  return sum;
}

// Of radio/*/relaying.
enum { own = 0, relayed = 1, control = 2 };

class Routings : public testing::Test {
 protected:
  Simulation world(const std::string& network, const std::string& routing, const std::string& elements, int workers = 1,
                   const std::string& dt = "0.1") const {
    const auto space = routing.find(' ');
    return world_of(folder,
                    elements + channel + "<" + network + " name=\"network\"/>\n<" + routing.substr(0, space) +
                        " name=\"routing\"" + (space == std::string::npos ? "" : routing.substr(space)) + "/>\n",
                    workers, dt);
  }
  const Folder folder;
};

class EachRouting : public Routings, public testing::WithParamInterface<std::tuple<std::string, std::string>> {
 protected:
  std::string network() const { return std::get<0>(GetParam()); }
  std::string routing() const { return std::get<1>(GetParam()); }
  bool relays() const { return routing() != "routing.none"; }

  Simulation world_with(const std::string& elements, int radios = 5, int workers = 1,
                        const std::string& dt = "0.1") const {
    folder.put("routes.csv", chain_routes(radios));
    return world(network(), routing() + (routing() == "routing.static" ? " routes=\"routes.csv\"" : ""), elements,
                 workers, dt);
  }
};

// ---- 19: messages -------------------------------------------------------------------------------------------------

TEST_P(EachRouting, Row19PayloadsArriveByteForByteWithTheirOriginAndTimes) {
  const int hops = relays() ? 4 : 1;
  const std::string target = "r" + std::to_string(hops), before = "r" + std::to_string(hops - 1);
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{1500}}) {
    const std::string what = "to=\"" + target + "\" only=\"2\" size=\"" + std::to_string(size) + "\"";
    Simulation sim = world_with(chain(5) + send("s", "r0", what));
    int came = 0;
    for (int tick = 1; tick < 200; ++tick) {
      sim.step();
      if (arrived(sim) == 0) continue;
      ++came;
      const TableView inbox = sim.table("inbox/*/message");
      EXPECT_TRUE(payload(sim, 0) == sent(size, 2));
      EXPECT_EQ(inbox.at(0, to), hops);
      EXPECT_EQ(inbox.at(0, from), 0);
      EXPECT_EQ(inbox.at(0, rssi), by_pair(sim, "link/*/rssi").at({before, target}));  // of the last hop
      EXPECT_NEAR(inbox.at(0, t_sent), 0.2, 1e-12);
      EXPECT_GT(inbox.at(0, t_received), 0.2);
      EXPECT_LE(inbox.at(0, t_received), sim.time());
    }
    EXPECT_EQ(came, 1) << size;
    EXPECT_EQ(journeys(sim, "r0", "delivered"), 1);
  }
}

TEST_P(EachRouting, Row19TenMegabytesArriveByteForByte) {
  if (!relays() || network() == "network.ns3") GTEST_SKIP() << "one hop, or slow";
  constexpr std::size_t size = 10'000'000;
  // As long a tick as there is, for a channel of 250 kbit/s needs ten minutes a hop.
  Simulation sim =
      world_with(chain(3) + send("s", "r0", "to=\"r2\" only=\"1\" size=\"" + std::to_string(size) + "\""), 3, 1, "100");
  for (int tick = 0; tick < 40; ++tick) {
    sim.step();
    if (arrived(sim) == 0) continue;
    EXPECT_TRUE(payload(sim, 0) == sent(size, 1));
    return;
  }
  FAIL() << "it did not arrive";
}

TEST_P(EachRouting, Row19WhatAPayloadClaimsIsOnlyAPayload) {
  Simulation sim = world_with(
      "<robot name=\"r0\" at=\"0 0 0\"/><robot name=\"r1\" at=\"0 1 0\"/><test.mover/>"
      "<test.forger robot=\"r1\" as=\"1\"/>",
      2);
  int came = 0;
  for (int tick = 0; tick < 10; ++tick) {
    sim.step();
    if (arrived(sim) == 0) continue;
    ++came;
    const TableView inbox = sim.table("inbox/*/message");
    EXPECT_EQ(payload(sim, 0), "from=another rssi=0 t_sent=99");
    EXPECT_EQ(inbox.at(0, from), 1);
    EXPECT_LT(inbox.at(0, rssi), 0);
    EXPECT_LT(inbox.at(0, t_sent), sim.time());
  }
  EXPECT_GE(came, 8);
}

// ---- 20: whatever the radio ---------------------------------------------------------------------------------------

TEST_P(EachRouting, Row20TheSameControllerRunsOnIt) {
  folder.put("roadmap.csv", "x[m],y[m]\n1,0\n11,0\n");
  Simulation sim =
      world_with("<robot name=\"r0\" at=\"1 0 0\" antenna=\"0 0 0.3\"/>" + station("r1", "0 0 0.3") +
                     "<physics.planar/><control.beacon radio=\"r1\"/>"
                     "<control.connectivity robot=\"r0\" roadmap=\"roadmap.csv\" parent=\"r1\" role=\"leader\"/>",
                 2);
  run(sim, 100);
  EXPECT_GT(sim.table("robot/r0/pose").at(0, 0), 2);  // it drives only while it hears the base well
}

// ---- 21, 23: every request has one outcome ------------------------------------------------------------------------

const std::string busy = send("s1", "r0", "to=\"r4\"") + send("s2", "r3", "to=\"r1\" size=\"90\" count=\"3\"") +
                         send("s3", "r2", "size=\"60\"") + send("s4", "r4", "to=\"r0\" size=\"300\"") +
                         send("s5", "r1", "to=\"r5\"") + send("s6", "r1", "to=\"r1\"");

std::string quiet_at(int tick) {
  std::string result;
  for (const auto& [name, radio] : std::map<std::string, std::string>{
           {"s1", "r0"}, {"s2", "r3"}, {"s3", "r2"}, {"s4", "r4"}, {"s5", "r1"}, {"s6", "r1"}})
    result += "<swap at=\"" + std::to_string(tick) + "\" instance=\"" + name + "\" plugin=\"test.sender\" from=\"" +
              radio + "\" count=\"0\"/>\n";
  return result;
}

// r5 is far away, and r4 leaves.
const std::string six = chain(5) + station("r5", "0 200 1") + "<test.leaver radio=\"r4\" at=\"30\"/>";

TEST_P(EachRouting, Row21NoRequestHasTwoOutcomesAndEachGetsOne) {
  Simulation sim = world_with(six + busy + quiet_at(5), 6);
  std::map<std::string, double> before;
  std::map<double, double> came;
  for (int tick = 1; tick <= 1400; ++tick) {
    sim.step();
    for (const std::string radio : {"r0", "r1", "r2", "r3", "r4"}) {
      EXPECT_LE(ended(sim, radio), journeys(sim, radio, "asked"));
      EXPECT_GE(ended(sim, radio), before[radio]);
      before[radio] = ended(sim, radio);
    }
    const TableView inbox = sim.table("inbox/*/message");
    for (std::size_t i = 0; i < arrived(sim); ++i) ++came[inbox.at(i, from)];
  }
  // Then nothing is under way. What a radio had under way when it left stays so, as all of its tables do.
  for (const int radio : {0, 1, 2, 3}) {
    const std::string name = "r" + std::to_string(radio);
    EXPECT_GE(journeys(sim, name, "asked"), 49) << name;
    EXPECT_EQ(ended(sim, name), journeys(sim, name, "asked")) << name;
    EXPECT_EQ(journeys(sim, name, "delivered"), came[radio]) << name;
  }
  EXPECT_GE(journeys(sim, "r0", "gone"), 19);
  EXPECT_GE(journeys(sim, "r1", "no_route"), 49);  // to itself
  EXPECT_EQ(journeys(sim, "r2", "asked") - journeys(sim, "r2", "delivered") - journeys(sim, "r2", "lost") -
                journeys(sim, "r2", "gone") - journeys(sim, "r2", "queue_full") - journeys(sim, "r2", "ttl_expired"),
            0);  // no broadcast needs a route
}

TEST_P(EachRouting, Row21AQueueHoldsSoManyAndRefusesTheRest) {
  folder.put("routes.csv", chain_routes(2));
  Simulation sim =
      world(network(), routing() + " queue=\"5\"" + (routing() == "routing.static" ? " routes=\"routes.csv\"" : ""),
            chain(2) + send("s", "r0", "to=\"r1\" count=\"20\" only=\"1\""));
  run(sim, 50);
  EXPECT_EQ(journeys(sim, "r0", "delivered"), 5);
  EXPECT_EQ(journeys(sim, "r0", "queue_full"), 15);
}

// ---- 22: connections come and go ----------------------------------------------------------------------------------

TEST_P(EachRouting, Row22ARadioThatJoinsHearsAndIsHeard) {
  Simulation sim = world_with(chain(1) + send("s", "r0") + "<test.joiner radio=\"late\" like=\"r0\" at=\"10\"/>", 1);
  run(sim, 10);
  EXPECT_EQ(journeys(sim, "r0", "asked"), 0);
  run(sim, 20);
  EXPECT_EQ(journeys(sim, "r0", "asked"), 20);
  EXPECT_GE(journeys(sim, "r0", "delivered"), 17);
}

// ---- 23: layers above the radio by other modules ------------------------------------------------------------------

TEST_P(EachRouting, Row23OnlyARoutingReachesWhoIsOutOfHearing) {
  Simulation sim = world_with(chain(5) + send("s", "r0", "to=\"r4\" only=\"1\""));
  run(sim, 150);
  EXPECT_EQ(journeys(sim, "r0", "delivered"), relays());
  if (!relays()) {
    EXPECT_EQ(journeys(sim, "r0", "lost"), 1);
  }
}

TEST_P(EachRouting, Row23ItTakesTheOverFromAnotherInMidRun) {
  const std::string attributes = routing() == "routing.static" ? " routes=\"routes.csv\"" : "";
  folder.put("routes.csv", chain_routes(5));
  for (const std::string other : {"routing.aodv", "routing.flooding"}) {
    Simulation sim =
        world(network(), other,
              chain(5) + send("s1", "r0", "to=\"r4\"") + send("s2", "r3", "to=\"r2\"") +
                  "<swap at=\"1.35\" instance=\"routing\" plugin=\"" + routing() + "\"" + attributes + "/>\n" +
                  "<swap at=\"3\" instance=\"s1\" plugin=\"test.sender\" from=\"r0\" count=\"0\"/>\n"
                  "<swap at=\"3\" instance=\"s2\" plugin=\"test.sender\" from=\"r3\" count=\"0\"/>\n");
    run(sim, 400);
    for (const std::string radio : {"r0", "r3"}) {
      EXPECT_GE(journeys(sim, radio, "asked"), 29);
      EXPECT_EQ(ended(sim, radio), journeys(sim, radio, "asked")) << other;
    }
    EXPECT_GE(journeys(sim, "r3", "delivered"), 20);
  }
}

// ---- Runs ---------------------------------------------------------------------------------------------------------

std::string digest_after(Simulation& sim, int ticks) {
  run(sim, ticks);
  return std::to_string(sim.digest());
}

TEST_P(EachRouting, ARunIsTheSameForAnyNumberOfWorkersAndAfterASnapshotInMidSearch) {
  if (network() == "network.ns3") GTEST_SKIP() << "one a process, and it cannot be restored";
  Simulation one = world_with(six + busy, 6), many = world_with(six + busy, 6, 3);
  run(one, 7);
  const Snapshot middle = one.snapshot();
  const std::string digest = digest_after(one, 60);
  EXPECT_EQ(digest, digest_after(many, 67));
  one.restore(middle);
  EXPECT_EQ(digest, digest_after(one, 60));
  Simulation fresh = world_with(six + busy, 6);
  fresh.restore(middle);
  EXPECT_EQ(digest, digest_after(fresh, 60));
}

std::vector<std::string> networks() {
  std::vector<std::string> result{"network.ideal", "network.lrwpan", "network.wifi"};
  if (std::filesystem::exists(MUSTER_PLUGINS_DIR "/network_ns3.so")) result.push_back("network.ns3");
  return result;
}
INSTANTIATE_TEST_SUITE_P(
    All, EachRouting,
    testing::Combine(testing::ValuesIn(networks()),
                     testing::Values("routing.none", "routing.flooding", "routing.static", "routing.aodv")),
    [](const auto& each) { return std::get<0>(each.param).substr(8) + "_" + std::get<1>(each.param).substr(8); });

// ---- Each routing's own laws --------------------------------------------------------------------------------------

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

// In a clique every radio hears every copy and says it once.
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
  EXPECT_EQ(journeys(sim, "r0", "no_route"), 1);  // r1 knows no way on
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

TEST_F(Static, RefusesATableThatCannotBe) {
  const auto error = [&](const std::string& rows) {
    folder.put("routes.csv", "at,to,next\n" + rows);
    try {
      Simulation sim = world("network.ideal", "routing.static routes=\"routes.csv\"", chain(3) + send("s", "r0"));
      sim.step();
    } catch (const Error& refused) {
      return std::string(refused.what());
    }
    return std::string("no error");
  };
  using testing::HasSubstr;
  EXPECT_THAT(error("r0,r2,r0\n"), HasSubstr("routes, row 1: r0 sends to itself; expected another radio as next"));
  EXPECT_THAT(error("r0,r2,r1\nr2,r2,r1\n"),
              HasSubstr("routes, row 2: r2 is where the message is for; expected a radio "
                        "that still has to send it"));
  EXPECT_THAT(error("r0,r2,r1\nr0,r2,r2\n"), HasSubstr("routes, row 2: r0 has a row for r2 already; expected one"));
  EXPECT_THAT(error("r0,,r1\nr0,,r2\n"), HasSubstr("routes, row 2: r0 has a row for all others already; expected one"));
  EXPECT_THAT(error("r0,r9,r1\n"), HasSubstr("routes.csv:2"));
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

// A ring: the other way round is there when a radio of the first one leaves.
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
