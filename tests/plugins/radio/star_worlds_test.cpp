// Stars of network.lrwpan in worlds: a coordinator, its beacons, and who hears them. The laws of superframes are tested
// in tests/plugins/network_lrwpan/slots_test.cpp. Row 24 of the requirements.
#include <gmock/gmock.h>

#include <map>

#include "world_of.hpp"

namespace muster {
namespace {

// Columns of radio/*/superframe and of radio/*/traffic.
enum { in_step = 0, heard, lost, silent, between_devices };
enum { asked = 0, delivered, too_weak, no_link, collided, no_access };

const std::string channel = "<radio.multiwall n=\"3\"/><radio.receiver sensitivity=\"-90\"/>\n";
const std::string four =
    station("a", "0 0 1") + station("hub", "3 0 1") + station("c", "0 4 1") + station("far", "400 0 1");

std::string network(const std::string& attributes) {
  return "<network.lrwpan name=\"network\" coordinator=\"hub\" " + attributes + "/>\n";
}
const std::string half_on = network("beacon_order=\"2\" superframe_order=\"1\"");

class StarWorld : public testing::Test {
 protected:
  Simulation world(const std::string& elements, int workers = 1) const {
    return world_of(folder, four + channel + elements, workers);
  }
  std::string error_of(const std::string& elements) const {
    try {
      Simulation sim = world(elements + send("s", "a"));
      sim.step();
    } catch (const Error& e) {
      EXPECT_EQ(e.exit(), Exit::invalid_input);
      const std::string what = e.what();
      return what.substr(what.find("world.xml"));
    }
    return "no error";
  }
  // Messages from a sender to a receiver.
  std::map<std::string, int> arrivals(Simulation& sim, int ticks) const {
    std::map<std::string, int> result;
    for (int tick = 0; tick < ticks; ++tick) {
      sim.step();
      const auto& names = sim.board().find_set("radio")->names;
      const TableView inbox = sim.table("inbox/*/message");
      for (std::size_t i = 0; i < inbox.rows(); ++i)
        ++result[names[static_cast<std::size_t>(inbox.at(i, 1))] + '>' +
                 names[static_cast<std::size_t>(inbox.at(i, 0))]];
    }
    return result;
  }
  static int told(const Simulation& sim, const std::string& message) {
    int times = 0;
    for (const auto& event : sim.events()) times += event.message.find(message) != std::string::npos;
    return times;
  }
  const Folder folder;
};

TEST_F(StarWorld, Row24DevicesAndTheirCoordinatorTalk) {
  Simulation sim = world(half_on + send("up", "a", "to=\"hub\"") + send("down", "hub", "to=\"c\"") +
                         send("all", "hub") + send("across", "a", "to=\"c\"") + send("far", "far", "to=\"hub\""));
  std::map<std::string, int> got = arrivals(sim, 50);
  EXPECT_GE(got["a>hub"], 48);
  EXPECT_GE(got["hub>a"], 48);
  EXPECT_GE(got["hub>c"], 2 * 48);
  EXPECT_EQ(got.size(), 3u);
  // 5 s have 82 superframes.
  const TableView superframe = sim.table("radio/*/superframe"), traffic = sim.table("radio/*/traffic");
  for (const std::size_t device : {0, 2}) {
    EXPECT_EQ(superframe.at(device, in_step), 1);
    EXPECT_EQ(superframe.at(device, heard), 82);
    EXPECT_EQ(superframe.at(device, lost), 0);
  }
  EXPECT_EQ(superframe.at(0, between_devices), 50);
  EXPECT_EQ(traffic.at(0, no_link), 50);
  EXPECT_EQ(superframe.at(3, in_step), 0);
  EXPECT_EQ(superframe.at(3, lost), 82);
  EXPECT_EQ(superframe.at(3, silent), 50);
  EXPECT_EQ(traffic.at(3, no_access), 50);
}

TEST_F(StarWorld, Row24WhyADeviceIsSilentIsTold) {
  Simulation sim = world(half_on + send("across", "a", "to=\"c\"") + send("far", "far", "to=\"hub\"") +
                         "<test.leaver radio=\"hub\" at=\"20\"/>");
  run(sim, 50);
  EXPECT_EQ(told(sim, "radio 'a' hears the beacons"), 0);  // as it should
  EXPECT_EQ(told(sim, "radio 'a' has lost 4 beacons of 'hub' in a row and is silent until it hears one"), 1);
  EXPECT_EQ(told(sim,
                 "radio 'far' has heard none of the first 4 beacons of 'hub' and is silent; expected a coordinator "
                 "within its reach"),
            1);
  EXPECT_EQ(told(sim,
                 "world.xml:7:1: radio 'a' sends to another device, to which a star has no link (no_link); expected "
                 "messages to 'hub', a routing that relays, such as routing.aodv, or no beacon_order"),
            1);
}

// A robot that drives out of reach falls silent, and is back in step when it comes back.
TEST_F(StarWorld, Row24ARobotLosesItsBeaconsAndFindsThemAgain) {
  Simulation sim = world_of(
      folder, station("hub", "0 0 0.2") + "<robot name=\"r\" at=\"1 0 0\"/><test.mover/><radio.multiwall n=\"3\"/>" +
                  "<radio.receiver sensitivity=\"-50\"/>" + network("beacon_order=\"0\"") + send("s", "r"));
  run(sim, 100);
  EXPECT_GE(told(sim, "radio 'r' hears the beacons of 'hub' and is in step again"), 4);
  EXPECT_GE(told(sim, "radio 'r' has lost 4 beacons"), 4);
  const TableView superframe = sim.table("radio/r/superframe"), traffic = sim.table("radio/r/traffic");
  EXPECT_GT(superframe.at(0, silent), 20);
  EXPECT_EQ(superframe.at(0, silent), traffic.at(0, no_access));
  EXPECT_GT(traffic.at(0, delivered), 20);
}

// As the warning says.
TEST_F(StarWorld, ARoutingRelaysBetweenDevices) {
  if (!std::filesystem::exists(std::filesystem::path(MUSTER_PLUGINS_DIR) / "routing_aodv.so")) GTEST_SKIP();
  Simulation sim = world(half_on + "<routing.aodv/>" + send("across", "a", "to=\"c\""));
  EXPECT_GE(arrivals(sim, 50)["a>c"], 45);
  EXPECT_EQ(told(sim, "sends to another device"), 0);
}

TEST_F(StarWorld, AnotherPanHasNoSuperframes) {
  Simulation sim = world(half_on + station("d", "5 5 1") + "<radio.pan name=\"p\" id=\"1\" radios=\"c d\"/>" +
                         send("s1", "c", "to=\"d\"") + send("s2", "a", "to=\"hub\""));
  std::map<std::string, int> got = arrivals(sim, 50);
  EXPECT_GE(got["c>d"], 48);
  EXPECT_GE(got["a>hub"], 48);
  EXPECT_EQ(sim.table("radio/c/superframe").at(0, heard), 0);
  EXPECT_EQ(sim.table("radio/c/superframe").at(0, lost), 0);
}

TEST_F(StarWorld, ARunIsTheSameBitsHoweverItIsRun) {
  const std::string elements = half_on + send("up", "a", "to=\"hub\" count=\"3\" size=\"300\"") +
                               send("down", "hub", "count=\"3\" size=\"60\"") + send("far", "far") +
                               send("c", "c", "to=\"a\"") + "<test.leaver radio=\"hub\" at=\"40\"/>";
  expect_same_run([&](int workers) { return world(elements, workers); }, {"network"}, 20);
}

// Orders that change in mid-run, by a swap and as a parameter.
TEST_F(StarWorld, TheOrdersMayChange) {
  Simulation sim = world(network("") + send("s", "a", "to=\"hub\"") +
                         "<swap at=\"2\" instance=\"network\" plugin=\"network.lrwpan\" coordinator=\"hub\" "
                         "beacon_order=\"2\"/>");
  EXPECT_GE(arrivals(sim, 20)["a>hub"], 19);
  EXPECT_GE(arrivals(sim, 20)["a>hub"], 19);
  EXPECT_NEAR(sim.table("radio/a/superframe").at(0, heard), 2 / 0.06144, 1);
  sim.set_parameter("network/beacon_order", 3);
  EXPECT_GE(arrivals(sim, 20)["a>hub"], 19);
  EXPECT_NEAR(sim.table("radio/a/superframe").at(0, heard), 2 / 0.06144 + 2 / 0.12288, 2);
  sim.set_parameter("network/beacon_order", 15);
  EXPECT_GE(arrivals(sim, 20)["a>hub"], 19);
  EXPECT_EQ(sim.table("radio/a/superframe").at(0, in_step), 0);
}

TEST_F(StarWorld, WithoutBeaconsThereIsNoTableOfThem) {
  Simulation sim = world(network("") + send("s", "a"));
  sim.step();
  EXPECT_THROW(sim.table("radio/*/superframe"), std::exception);
}

TEST_F(StarWorld, WhatIsDeclaredWronglyIsTold) {
  EXPECT_THAT(error_of(network("beacon_order=\"2\" superframe_order=\"3\"")),
              testing::HasSubstr("attribute \"superframe_order\": is above beacon_order (2); expected at most that, "
                                 "since the active part lies within the time between beacons"));
  EXPECT_THAT(error_of(network("beacon_order=\"16\"")),
              testing::HasSubstr("attribute \"beacon_order\": 16 is out of bounds; expected an integer from 0 to 15"));
  EXPECT_THAT(error_of("<network.lrwpan beacon_order=\"3\" coordinator=\"hubb\"/>"),
              testing::HasSubstr("did you mean \"hub\"?"));
  EXPECT_THAT(error_of("<network.lrwpan superframe_order=\"3\"/>"),
              testing::HasSubstr("attribute \"superframe_order\": is given without beacon_order"));
}

}  // namespace
}  // namespace muster
