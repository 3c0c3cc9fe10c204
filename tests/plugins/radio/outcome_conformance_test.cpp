// Conformance of every network: each request is evaluated, and each of its copies has one outcome (row 21 of
// tests/README.md).
#include "each_network.hpp"

namespace muster {
namespace {

TEST_P(EachNetwork, Row21NoCopyHasTwoOutcomesAndEachGetsOne) {
  std::string quiet;
  for (const auto& [name, radio] :
       std::map<std::string, std::string>{{"s1", "a"}, {"s2", "b"}, {"s3", "c"}, {"s5", "b"}, {"s6", "b"}})
    quiet += "<swap at=\"6\" instance=\"" + name + "\" plugin=\"test.sender\" from=\"" + radio + "\" count=\"0\"/>\n";
  for (const std::string& senders : {busy, jammed, apart}) {
    Simulation sim = world(senders + quiet);
    std::vector<double> before(6, 0);
    for (int tick = 0; tick < 90; ++tick) {
      sim.step();
      const TableView traffic = sim.table("radio/*/traffic");
      for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_LE(sum_of_outcomes(traffic, i), traffic.at(i, 0));
        EXPECT_GE(sum_of_outcomes(traffic, i), before[i]);
        before[i] = sum_of_outcomes(traffic, i);
      }
    }
    // Three seconds after the last request nothing is under way.
    const TableView traffic = sim.table("radio/*/traffic");
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_GT(traffic.at(i, 0), 0);
      EXPECT_EQ(sum_of_outcomes(traffic, i), traffic.at(i, 0)) << i;
    }
  }
}

TEST_P(EachNetwork, Row21AsMuchArrivesAsIsCountedAsDelivered) {
  for (const std::string& senders : {busy, apart}) {
    Simulation sim = world(senders);
    std::vector<double> arrived(6, 0);
    for (int tick = 0; tick < 50; ++tick) {
      sim.step();
      const TableView inbox = sim.table("inbox/*/message");
      for (std::size_t i = 0; i < inbox.rows(); ++i) ++arrived[static_cast<std::size_t>(inbox.at(i, 1))];
    }
    for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(sim.table("radio/*/traffic").at(i, 1), arrived[i]) << i;
  }
}

TEST_P(EachNetwork, Row21NothingArrivesWithoutALinkOrOutOfHearing) {
  Simulation sim = world(send("s1", "a", "to=\"far\"") + send("s2", "b", "to=\"gone\""));
  for (int tick = 0; tick < 30; ++tick) {
    sim.step();
    EXPECT_EQ(sim.table("inbox/*/message").rows(), 0u);
  }
  EXPECT_GT(traffic(sim, "a", "too_weak"), 20);
  EXPECT_GT(traffic(sim, "b", "no_link"), 20);
}

TEST_P(EachSharedChannel, Row21AQueueHoldsSoManyAndRefusesTheRest) {
  Simulation sim = world_of(folder, station("a", "0 0 1") + station("b", "3 0 1") + walls_and_fading +
                                        network("queue=\"5\" spread=\"false\"") +
                                        send("s", "a", "to=\"b\" count=\"20\" only=\"1\""));
  run(sim, 10);
  EXPECT_EQ(traffic(sim, "a", "delivered"), 6);  // and the one that is sent at once
  EXPECT_EQ(traffic(sim, "a", "queue_full"), 14);
}

// In a tick of 10 ns one request in 20 is nearer to its end than half a nanosecond.
TEST_P(EachSharedChannel, Row21ARequestAtTheVeryEndOfItsTickIsEvaluated) {
  constexpr int ticks = 20;
  Simulation sim = world(send("s", "a", "to=\"b\" count=\"20\""), 1, "1e-08");
  run(sim, ticks);
  EXPECT_EQ(traffic(sim, "a", "asked"), 20 * ticks);
}

TEST_P(EachSharedChannel, Row21AirTimeThrottles) {
  Simulation sim = world(send("s", "a", "to=\"b\" count=\"100\" size=\"10000\""));
  double bits = 0;
  for (int tick = 0; tick < 30; ++tick) {
    sim.step();
    bits += 8 * 10000.0 * static_cast<double>(sim.table("inbox/*/message").rows());
  }
  // Bounds of its throughput, since every network has some overhead; default as 802.15.4.
  const std::map<std::string, std::pair<double, double>> rates{{"network.wifi", {3e6, 49e6}},
                                                               {"network.bluetooth", {400e3, 723e3}}};
  const auto found = rates.find(GetParam());
  const auto [least, most] = found != rates.end() ? found->second : std::pair{80e3, 225e3};
  EXPECT_GT(bits / sim.time(), least);
  EXPECT_LT(bits / sim.time(), most);
  EXPECT_GT(traffic(sim, "a", "queue_full"), 0);
}

}  // namespace
}  // namespace muster
