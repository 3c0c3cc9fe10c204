// Conformance of every routing on every network, each identified by its file alone. tests/README.md lists the rows.
#include <map>

#include "routing_worlds.hpp"

namespace muster {
namespace {

// Columns of an inbox.
enum { to = 0, from = 1, rssi = 2, t_sent = 3, t_received = 4 };

std::string payload(const Simulation& sim, std::size_t row) {
  const TableView inbox = sim.table("inbox/*/message");
  const auto blob = static_cast<std::size_t>(inbox.at(row, Incoming::payload_column));
  if (blob == 0) return "";
  const auto& bytes = *inbox.table->now().blobs[blob - 1];
  return {bytes.begin(), bytes.end()};
}

// Payload of test.sender in a tick.
std::string sent(std::size_t size, uint64_t tick) {
  std::string result(size, '\0');
  for (std::size_t i = 0; i < size; ++i) result[i] = static_cast<char>(mixed(i + tick));
  return result;
}

double ended(const Simulation& sim, const std::string& radio) {
  double sum = 0;
  for (const auto& outcome : outcomes) sum += journeys(sim, radio, outcome);
  return sum;
}

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
  // The longest tick allowed, for a channel of 250 kbit/s needs ten minutes a hop.
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
  EXPECT_GT(sim.table("robot/r0/pose").at(0, 0), 2);  // it drives only while its link to the base is good
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
  // Then nothing is under way. Counts of a radio that left stay, as in all of its tables.
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

}  // namespace
}  // namespace muster
