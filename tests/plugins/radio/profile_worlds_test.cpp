// Profiles of networks: sensitivity, step, lowest and highest reading of a mode, without an element beside the network.
// Row 24 of the requirements.
#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <set>

#include "each_network.hpp"

namespace muster {
namespace {

struct Profile {
  std::string network;
  double step, least, most, sensitivity;
  friend void PrintTo(const Profile& p, std::ostream* out) { *out << p.network; }
};

// Links of -20 dBm and of less than the receiver's -95 dBm, and all between.
const std::string places = station("a", "0 0 1") + station("b", "1 0 1") + station("c", "0 9 1") +
                           station("d", "22 5 1") + station("e", "80 5 1") + station("f", "150 5 1") +
                           station("g", "29 9 1");
const std::string channel = "<radio.multiwall n=\"3\" l0=\"30\" tx_power=\"10\"/><radio.fading shadowing=\"4\"/>";
const std::string senders = send("s1", "a") + send("s2", "d") + send("s3", "f", "to=\"a\"");

// Readings that messages arrived with in a tick, by sender and receiver.
std::map<Pair, double> received(const Simulation& sim) {
  std::map<Pair, double> result;
  const auto& names = sim.board().find_set("radio")->names;
  const TableView inbox = sim.table("inbox/*/message");
  for (std::size_t i = 0; i < inbox.rows(); ++i)
    result[{names[static_cast<std::size_t>(inbox.at(i, 1))], names[static_cast<std::size_t>(inbox.at(i, 0))]}] =
        inbox.at(i, 2);
  return result;
}

class EachProfile : public testing::TestWithParam<Profile> {
 protected:
  const Profile profile = GetParam();
  std::string network(const std::string& attributes) const {
    return "<" + profile.network + " name=\"network\" " + attributes + "/>\n";
  }
  Simulation world(const std::string& elements, int workers = 1) const {
    return world_of(folder, places + channel + elements + senders, workers);
  }
  static std::string steps(double step, double least, double most) {
    return "<radio.rssi_steps name=\"codes\" step=\"" + std::to_string(step) + "\" least=\"" + std::to_string(least) +
           "\" most=\"" + std::to_string(most) + "\"/>";
  }
  static std::string receiver(double sensitivity) {
    return "<radio.receiver sensitivity=\"" + std::to_string(sensitivity) + "\"/>";
  }
  std::string error_of(const std::string& elements) const {
    try {
      Simulation sim = world(elements);
      sim.step();
    } catch (const Error& e) {
      EXPECT_EQ(e.exit(), Exit::invalid_input);
      return e.what();
    }
    return "no error";
  }
  // All that is received and how it is counted is the same, tick by tick.
  static void expect_same(Simulation& one, Simulation& other) {
    for (int tick = 0; tick < 30; ++tick) {
      one.step(), other.step();
      for (const std::string table : {"inbox/*/message", "radio/*/traffic"}) {
        const TableView a = one.table(table), b = other.table(table);
        ASSERT_EQ(a.rows(), b.rows());
        for (std::size_t row = 0; row < a.rows(); ++row)
          for (std::size_t column = 0; column < 6; ++column)
            EXPECT_TRUE(same_bits(a.at(row, column), b.at(row, column))) << table << ' ' << row << ' ' << column;
      }
    }
  }
  const Folder folder;
};
const auto name_of = [](const testing::TestParamInfo<Profile>& info) { return info.param.network.substr(8); };
INSTANTIATE_TEST_SUITE_P(Modes, EachProfile,
                         testing::Values(Profile{"network.lrwpan", 1, -100, 0, -85},
                                         Profile{"network.wifi", 0.5, -110, 0, -82},
                                         Profile{"network.bluetooth", 1, -127, 20, -70}),
                         name_of);

// What a message arrives with is the nearest step within the ends, and none arrives from below the sensitivity.
TEST_P(EachProfile, Row24StatesItsReadings) {
  Simulation sim = world(network("rssi=\"profile\"") + send("s4", "e") + send("s5", "a", "to=\"e\""));
  std::map<Pair, double> heard;
  for (int tick = 0; tick < 30; ++tick) {
    sim.step();
    for (const auto& [pair, rssi] : received(sim)) heard[pair] = rssi;
  }
  int unheard = 0;
  for (const auto& [pair, exact] : by_pair(sim, "link/*/rssi")) {
    const auto found = heard.find(pair);
    EXPECT_TRUE(found == heard.end() || exact >= profile.sensitivity);
    unheard += !std::isnan(exact) && exact < profile.sensitivity;
    if (found == heard.end()) continue;
    EXPECT_EQ(std::fmod(found->second, profile.step), 0);
    EXPECT_LE(std::abs(found->second - exact), profile.step / 2);
  }
  EXPECT_GE(heard.size(), 5u);
  EXPECT_GE(unheard, 2);
}

// Messages are as the two elements beside the network would make them.
TEST_P(EachProfile, Row24IsAsReceiverAndStepsBesideIt) {
  Simulation by_profile = world(network("rssi=\"profile\""));
  Simulation by_elements =
      world(receiver(profile.sensitivity) + steps(profile.step, profile.least, profile.most) + network(""));
  expect_same(by_profile, by_elements);
  EXPECT_GT(traffic(by_profile, "a", "delivered"), 30);
}

TEST_P(EachProfile, Row24AnAttributeWins) {
  const std::string attributes = "rssi_step=\"3\" rssi_least=\"-60\" rssi_most=\"-45\" sensitivity=\"-66\"";
  Simulation by_profile = world(network("rssi=\"profile\" " + attributes));
  Simulation by_elements = world(receiver(-66) + steps(3, -60, -45) + network(""));
  expect_same(by_profile, by_elements);
  std::set<double> seen;
  for (int tick = 0; tick < 20; ++tick) {
    by_profile.step();
    for (const auto& [pair, rssi] : received(by_profile)) seen.insert(rssi);
  }
  ASSERT_GE(seen.size(), 2u);
  EXPECT_LE(*seen.begin(), -54);
  EXPECT_GE(*seen.begin(), -60);
  EXPECT_EQ(*seen.rbegin(), -45);
}

// Steps that the world gives stand, whatever they are called; the sensitivity is the profile's, of readings in these
// steps.
TEST_P(EachProfile, Row24StepsOfTheWorldWin) {
  Simulation by_profile = world(steps(0.125, -130, 50) + network("rssi=\"profile\""));
  Simulation by_elements = world(receiver(profile.sensitivity - 0.0625) + steps(0.125, -130, 50) + network(""));
  expect_same(by_profile, by_elements);
  int between = 0;
  for (const auto& [pair, rssi] : received(by_profile)) between += std::fmod(rssi, profile.step) != 0;
  EXPECT_GT(between, 0);
}

// Other tables do not change, so that fits, maps and probes are those of the channel.
TEST_P(EachProfile, TheChannelStaysAsItIs) {
  Simulation exact = world(network("")), by_profile = world(network("rssi=\"profile\""));
  run(exact, 3), run(by_profile, 3);
  expect_same_bits(by_pair(exact, "link/*/rssi"), by_pair(by_profile, "link/*/rssi"));
  for (const auto& [pair, rssi] : received(exact)) EXPECT_EQ(rssi, by_pair(exact, "link/*/rssi").at(pair));
}

TEST_P(EachProfile, ARunIsTheSameBitsHoweverItIsRun) {
  expect_same_run([&](int workers) { return world(network("rssi=\"profile\""), workers); }, {"network"}, 20);
}

TEST_P(EachProfile, WhatIsDeclaredWronglyIsTold) {
  EXPECT_THAT(error_of(network("rssi_step=\"2\"")),
              testing::HasSubstr("attribute \"rssi_step\": is of the profile, and rssi is exact; expected "
                                 "rssi=\"profile\" beside it, or radio.receiver and radio.rssi_steps in the world"));
  EXPECT_THAT(error_of(network("rssi=\"profile\" rssi_least=\"-40\" rssi_most=\"-50\"")),
              testing::HasSubstr("attribute \"rssi_least\": is above rssi_most; expected at most that"));
  EXPECT_THAT(error_of(network("rssi=\"profil\"")), testing::HasSubstr("did you mean \"profile\"?"));
}

// The faster, the less sensitive (IEEE 802.11-2016, table 17-18). Levels along a line of radios are 1 dB apart.
TEST(WifiProfile, Row24SensitivityIsTheRates) {
  const Folder folder;
  std::string line = station("first", "0 0 1") + send("s", "first");
  for (int i = 0; i < 40; ++i)
    line += station("r" + std::to_string(i), std::to_string(std::pow(10, (10.5 + i) / 20)) + " 0 1");
  const auto least = [&](const std::string& attributes) {  // reading of a message
    Simulation sim = world_of(folder, line + "<radio.multiwall n=\"2\" l0=\"40\" tx_power=\"0\"/>" +
                                          "<network.wifi rssi=\"profile\" " + attributes + "/>");
    double result = 0;
    for (int tick = 0; tick < 3; ++tick) {
      sim.step();
      for (const auto& [pair, rssi] : received(sim)) result = std::min(result, rssi);
    }
    return result;
  };
  for (const auto& [rate, sensitivity] : std::map<std::string, double>{
           {"6", -82}, {"9", -81}, {"12", -79}, {"18", -77}, {"24", -74}, {"36", -70}, {"48", -66}, {"54", -65}})
    EXPECT_NEAR(least("rate=\"" + rate + "\""), sensitivity + 0.5, 1e-9) << rate;
  EXPECT_NEAR(least("rate=\"6\" sensitivity=\"-75\""), -74.5, 1e-9);
}

}  // namespace
}  // namespace muster
