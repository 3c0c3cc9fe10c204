// Conformance of every network: messages, and their course through the world. outcome_conformance_test.cpp tests
// outcomes; tests/README.md lists the rows.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "each_network.hpp"
#include "messages.hpp"

namespace muster {
namespace {

// Columns of an inbox.
enum { to = 0, from = 1, rssi = 2, t_sent = 3, t_received = 4, lqi = 5 };

// ---- 19: messages -------------------------------------------------------------------------------------------------

TEST_P(EachNetwork, Row19PayloadsOfAnySizeArriveByteForByte) {
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{1500}}) {
    Simulation sim = world(send("s", "a", "to=\"b\" size=\"" + std::to_string(size) + "\""));
    int arrived = 0;
    for (int tick = 0; tick < 20; ++tick) {
      sim.step();
      const TableView inbox = sim.table("inbox/*/message");
      for (std::size_t i = 0; i < inbox.rows(); ++i, ++arrived) {
        // The sender's bytes encode the tick of their making.
        const auto made = static_cast<uint64_t>(std::ceil(inbox.at(i, t_sent) / 0.1 - 1e-9));
        EXPECT_TRUE(payload(sim, i) == sent(size, made));
      }
    }
    EXPECT_GE(arrived, 18) << size;
  }
}

TEST_P(EachNetwork, Row19TenMegabytesArriveByteForByte) {
  constexpr std::size_t size = 10'000'000;
  // The longest tick allowed, for a channel of 250 kbit/s needs ten minutes.
  Simulation sim = world(send("s", "a", "to=\"b\" only=\"1\" size=\"" + std::to_string(size) + "\""), 1, "100");
  for (int tick = 0; tick < 12; ++tick) {
    sim.step();
    if (sim.table("inbox/*/message").rows() == 0) continue;
    EXPECT_TRUE(payload(sim, 0) == sent(size, 1));
    return;
  }
  FAIL() << "it did not arrive";
}

TEST_P(EachNetwork, Row19TheReceivingSideSaysFromWhomHowStrongHowWellAndWhen) {
  Simulation sim = world(send("s", "a", "to=\"b\""));
  int arrived = 0;
  for (int tick = 0; tick < 20; ++tick) {
    const double began = sim.time();
    sim.step();
    const TableView inbox = sim.table("inbox/*/message");
    for (std::size_t i = 0; i < inbox.rows(); ++i, ++arrived) {
      EXPECT_EQ(inbox.at(i, to), 1);
      EXPECT_EQ(inbox.at(i, from), 0);
      EXPECT_EQ(inbox.at(i, rssi), by_pair(sim, "link/*/rssi").at({"a", "b"}));
      EXPECT_LE(inbox.at(i, t_sent), inbox.at(i, t_received));
      EXPECT_GE(inbox.at(i, t_received), began);
      EXPECT_LT(inbox.at(i, t_received), sim.time() + 1e-9);
      EXPECT_EQ(std::isnan(inbox.at(i, lqi)), !shares_a_channel());
      if (shares_a_channel()) {
        EXPECT_GT(inbox.at(i, lqi), 200);  // 3 m
      }
    }
  }
  EXPECT_GE(arrived, 18);
}

TEST_P(EachNetwork, Row19AFurtherSenderMovesNoRequestOfAnother) {
  const auto moments = [&](const std::string& senders) {
    Simulation sim = world(senders);
    std::set<double> sent;
    for (int tick = 0; tick < 40; ++tick) {
      sim.step();
      const TableView inbox = sim.table("inbox/*/message");
      for (std::size_t i = 0; i < inbox.rows(); ++i) {
        if (inbox.at(i, from) == 3) sent.insert(inbox.at(i, t_sent));
      }
    }
    return sent;
  };
  const std::string of_d = send("s2", "d", "to=\"a\"");
  const std::set<double> alone = moments(of_d), beside = moments(send("s1", "a", "to=\"c\"") + of_d);
  EXPECT_GE(beside.size(), 20u);
  EXPECT_TRUE(std::includes(alone.begin(), alone.end(), beside.begin(), beside.end()));
}

TEST_P(EachSharedChannel, Row19LinkQualityFallsWithDistance) {
  double last = 256;
  for (const int distance : {20, 40, 60}) {
    Simulation sim = world_of(folder, station("a", "0 0 1") + station("b", std::to_string(distance) + " 0 1") +
                                          "<radio.multiwall n=\"3\"/><radio.receiver sensitivity=\"-110\"/>" +
                                          network("noise=\"-107\"") + send("s", "a", "to=\"b\""));
    while (sim.table("inbox/*/message").rows() == 0) sim.step();
    const double quality = sim.table("inbox/*/message").at(0, lqi);
    EXPECT_LT(quality, last);
    EXPECT_GT(quality, 0);
    EXPECT_EQ(quality, std::round(quality));
    last = quality;
  }
}

const std::string two_robots =
    "<robot name=\"honest\" at=\"0 0 0\"/><robot name=\"forger\" at=\"0 1 0\"/><test.mover/>";

TEST_P(EachNetwork, Row19ASenderCannotSpeakForAnother) {
  Simulation sim =
      world_of(folder, two_robots + walls_and_fading + network() + "<test.forger robot=\"forger\" as=\"0\"/>");
  try {
    run(sim, 2);
    FAIL() << "forged";
  } catch (const Error& refused) {
    EXPECT_THAT(
        refused.what(),
        testing::HasSubstr("outbox/forger/message: radio is 0, which is honest, but it speaks for forger alone; "
                           "expected \"radio\" to be left as send() and append() fill it in, and whom it is "
                           "for in \"to\""));
  }
}

TEST_P(EachNetwork, Row19WhatAPayloadClaimsIsOnlyAPayload) {
  Simulation sim =
      world_of(folder, two_robots + walls_and_fading + network() + "<test.forger robot=\"forger\" as=\"1\"/>");
  int arrived = 0;
  for (int tick = 0; tick < 10; ++tick) {
    sim.step();
    const TableView inbox = sim.table("inbox/*/message");
    for (std::size_t i = 0; i < inbox.rows(); ++i, ++arrived) {
      EXPECT_EQ(payload(sim, i), "from=another rssi=0 t_sent=99");
      EXPECT_EQ(inbox.at(i, from), 1);
      EXPECT_LT(inbox.at(i, rssi), 0);
      EXPECT_LE(inbox.at(i, t_sent), sim.time());
    }
  }
  EXPECT_GE(arrived, 9);
}

// ---- 20: whatever the radio ---------------------------------------------------------------------------------------

TEST_P(EachNetwork, Row20TheSameControllerRunsOnIt) {
  folder.put("roadmap.csv", "x[m],y[m]\n1,0\n20,0\n");
  Simulation sim = world_of(
      folder, station("base", "0 0 0.3") +
                  "<robot name=\"leader\" at=\"1 0 0\" antenna=\"0 0 0.3\"/><physics.planar/>" + walls_and_fading +
                  network() + "<control.beacon radio=\"base\"/>" +
                  "<control.connectivity robot=\"leader\" roadmap=\"roadmap.csv\" parent=\"base\" role=\"leader\"/>");
  run(sim, 100);
  EXPECT_GT(sim.table("robot/leader/pose").at(0, 0), 2);  // it drives only while its link to the base is good
}

// ---- 22: connections come and go ----------------------------------------------------------------------------------

TEST_P(EachNetwork, Row22WhoHearsWhomIsThatOfTheMoment) {
  // The robot goes 3 m away and comes back every two seconds; beyond 2.2 m from the base no message arrives.
  Simulation sim = world_of(folder, station("base", "0 0 0.2") + "<robot name=\"r\" at=\"1 0 0\"/><test.mover/>" +
                                        "<radio.multiwall n=\"3\"/><radio.receiver sensitivity=\"-50\"/>" + network() +
                                        send("s", "r"));
  int heard = 0, unheard = 0;
  bool was_in_reach = false;
  for (int tick = 0; tick < 60; ++tick) {
    sim.step();
    const bool in_reach = !std::isnan(by_pair(sim, "link/*/rssi").at({"r", "base"}));
    const auto arrived = static_cast<int>(sim.table("inbox/*/message").rows());
    if (!in_reach && !was_in_reach) {
      EXPECT_EQ(arrived, 0) << tick;
    }
    (in_reach ? heard : unheard) += arrived;
    was_in_reach = in_reach;
  }
  EXPECT_GE(heard, 20);
  EXPECT_LE(unheard, 3);  // requested at the end of a tick in reach
}

TEST_P(EachNetwork, Row22ARadioThatJoinsHearsAndIsHeard) {
  Simulation sim = world_of(folder, station("a", "0 0 1") + walls_and_fading + network() + send("s", "a") +
                                        "<test.joiner radio=\"late\" like=\"a\" at=\"10\"/>");
  run(sim, 10);
  EXPECT_EQ(traffic(sim, "a", "asked"), 0);
  run(sim, 20);
  EXPECT_GE(traffic(sim, "a", "asked"), 19);
  EXPECT_GE(traffic(sim, "a", "delivered"), 18);
  EXPECT_EQ(sim.table("inbox/*/message").at(0, to), 1);
}

TEST_P(EachNetwork, Row22AMessageToARadioThatLeftIsDroppedWithThatReason) {
  Simulation sim = world(send("s1", "a", "to=\"d\"") + send("s2", "d") + "<test.leaver radio=\"d\" at=\"10\"/>");
  run(sim, 12);
  const double delivered = traffic(sim, "a", "delivered"), said = traffic(sim, "d", "delivered");
  EXPECT_GE(delivered, 8);
  run(sim, 20);
  EXPECT_EQ(traffic(sim, "a", "delivered"), delivered);
  EXPECT_GE(traffic(sim, "a", "gone"), 19);
  EXPECT_EQ(traffic(sim, "a", "no_link"), 0);
  // Nor does it send anything itself.
  EXPECT_EQ(traffic(sim, "d", "delivered"), said);
  EXPECT_EQ(sum_of_outcomes(sim.table("radio/d/traffic"), 0), traffic(sim, "d", "asked"));
}

// ---- 28: environments change --------------------------------------------------------------------------------------

TEST_P(EachNetwork, Row28ADoorThatOpensIsHeardInItsTick) {
  Simulation sim =
      world_of(folder,
               "<material name=\"steel\" loss=\"17\"/><wall name=\"w\" from=\"2 -5\" to=\"2 5\" material=\"steel\"/>"
               "<door name=\"d\" wall=\"w\" at=\"4\" width=\"2\" state=\"closed\"/>" +
                   station("a", "0 0 1") + station("b", "4 0 1") + "<radio.multiwall n=\"2\"/>" + network() +
                   send("s", "a", "to=\"b\"") + "<test.porter at=\"11\"/>");
  const double open = -40 - 20 * std::log10(4.0);
  std::map<bool, int> arrived;
  for (int tick = 1; tick <= 20; ++tick) {
    sim.step();
    const TableView inbox = sim.table("inbox/*/message");
    for (std::size_t i = 0; i < inbox.rows(); ++i) {
      if (tick == 11 && inbox.at(i, t_sent) < sim.time() - 0.1) continue;  // its frame began before
      const bool was_open = tick >= 11;
      EXPECT_NEAR(inbox.at(i, rssi), was_open ? open : open - 17, 1e-9) << tick;
      ++arrived[was_open];
    }
  }
  EXPECT_GE(arrived[false], 8);
  EXPECT_GE(arrived[true], 8);
}

// ---- 30: the channel is the environment's -------------------------------------------------------------------------

TEST_P(EachNetwork, Row30MessagesMeetTheSameChannelOnReturn) {
  Simulation sim = world_of(folder, station("base", "0 0 0.2") + "<robot name=\"r\" at=\"1 0 0\"/><test.mover/>" +
                                        walls_and_fading + network() + send("s", "r"));
  std::map<int, std::set<double>> heard;  // by tick of the round trip
  for (int tick = 1; tick <= 80; ++tick) {
    sim.step();
    const TableView inbox = sim.table("inbox/*/message");
    for (std::size_t i = 0; i < inbox.rows(); ++i) {
      const bool in_one_tick = inbox.at(i, t_sent) > sim.time() - 0.1;
      if (in_one_tick || !shares_a_channel()) heard[std::min(tick % 20, 20 - tick % 20)].insert(inbox.at(i, rssi));
    }
  }
  std::set<double> all;
  for (const auto& [place, levels] : heard) {
    EXPECT_EQ(levels.size(), 1u) << place;
    all.insert(levels.begin(), levels.end());
  }
  EXPECT_GE(all.size(), 9u);
}

// ---- However it is run --------------------------------------------------------------------------------------------

double total(const Simulation& sim, const std::string& column) {
  double sum = 0;
  for (const char* radio : {"a", "b", "c", "d", "far", "gone"}) sum += traffic(sim, radio, column);
  return sum;
}

double without_outcome(const Simulation& sim) {
  const TableView traffic = sim.table("radio/*/traffic");
  double sum = 0;
  for (std::size_t i = 0; i < traffic.rows(); ++i) sum += traffic.at(i, 0) - sum_of_outcomes(traffic, i);
  return sum;
}

// Messages under way are lost, and never get an outcome; the other network carries later ones, and counts go on.
TEST_P(EachNetwork, AnotherTakesOverInMidRun) {
  if (GetParam() == "network.ns3") GTEST_SKIP() << "one a process";
  for (const std::string& other : networks(GetParam().substr(8))) {
    if (other == "network.ns3") continue;
    Simulation sim = world(busy);
    run(sim, 20);
    InstanceDeclaration declared;
    declared.plugin = other;
    sim.swap("network", declared);
    const double asked = total(sim, "asked"), delivered = total(sim, "delivered"), lost = without_outcome(sim);
    double arrived = 0;
    for (int k = 0; k < 30; ++k) {
      sim.step();
      arrived += static_cast<double>(sim.table("inbox/*/message").rows());
      EXPECT_GE(without_outcome(sim), lost) << other;
    }
    EXPECT_GT(arrived, 0) << other;
    EXPECT_EQ(total(sim, "delivered") - delivered, arrived) << other;
    EXPECT_GT(total(sim, "asked"), asked) << other;
    if (other == "network.ideal") {  // it keeps none under way itself
      EXPECT_EQ(without_outcome(sim), lost);
    }
  }
}

TEST_P(EachNetwork, ARunIsTheSameBitsHoweverItIsRun) {
  if (GetParam() == "network.ns3") GTEST_SKIP() << "one a process, and it cannot be restored";
  for (const std::string& senders : {busy, jammed})
    expect_same_run([&](int workers) { return world(senders, workers); }, {"network"}, 20);
}

const auto name_of = [](const testing::TestParamInfo<std::string>& network) { return network.param.substr(8); };
INSTANTIATE_TEST_SUITE_P(Plugins, EachNetwork, testing::ValuesIn(networks()), name_of);
INSTANTIATE_TEST_SUITE_P(Plugins, EachSharedChannel, testing::ValuesIn(networks("ideal")), name_of);
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(EachSharedChannel);  // if those folders of plugins were removed

}  // namespace
}  // namespace muster
