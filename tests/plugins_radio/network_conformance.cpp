// What every network must keep, known by nothing but its file: each copy has one outcome, what arrives is what was
// sent, the receiving side says from whom and when, and a run is the same bits however it is run.
#include <gmock/gmock.h>

#include "world_of.hpp"

namespace muster {
namespace {

class EachNetwork : public testing::TestWithParam<std::string> {
 protected:
  // Four radios in a room, one out of hearing, one without any link.
  Simulation world(const std::string& senders, int workers = 1) const {
    return world_of(folder,
                    station("a", "0 0 1") + station("b", "3 0 1") + station("c", "0 4 1") + station("d", "5 5 1") +
                        station("far", "400 0 1") + station("gone", "0 900 1") +
                        "<radio.links range=\"600\"/><radio.multiwall n=\"3\"/><radio.fading shadowing=\"2\"/>"
                        "<radio.receiver sensitivity=\"-90\"/><" +
                        GetParam() + " name=\"network\"/>" + senders,
                    workers);
  }
  const Folder folder;
};

double sum_of_outcomes(const TableView& traffic, std::size_t row) {
  double sum = 0;
  for (std::size_t c = 1; c < traffic.cols(); ++c) sum += traffic.at(row, c);
  return sum;
}

const std::string busy =
    "<test.sender name=\"s1\" from=\"a\"/><test.sender name=\"s2\" from=\"b\" to=\"c\" count=\"5\" size=\"90\"/>"
    "<test.sender name=\"s3\" from=\"c\" size=\"60\" count=\"3\"/><test.sender name=\"s4\" from=\"d\" to=\"a\" "
    "size=\"700\"/>"
    "<test.sender name=\"s5\" from=\"b\" to=\"far\"/><test.sender name=\"s6\" from=\"b\" to=\"gone\"/>"
    "<test.leaver radio=\"d\" at=\"30\"/>";

TEST_P(EachNetwork, NoCopyHasTwoOutcomesAndEachGetsOne) {
  Simulation sim = world(busy +
                         "<swap at=\"6\" instance=\"s1\" plugin=\"test.sender\" from=\"a\" count=\"0\"/>"
                         "<swap at=\"6\" instance=\"s2\" plugin=\"test.sender\" from=\"b\" count=\"0\"/>"
                         "<swap at=\"6\" instance=\"s3\" plugin=\"test.sender\" from=\"c\" count=\"0\"/>"
                         "<swap at=\"6\" instance=\"s5\" plugin=\"test.sender\" from=\"b\" count=\"0\"/>"
                         "<swap at=\"6\" instance=\"s6\" plugin=\"test.sender\" from=\"b\" count=\"0\"/>");
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

TEST_P(EachNetwork, PayloadsArriveByteForByteAndTheReceivingSideSaysTheRest) {
  for (const int size : {0, 1, 1500}) {
    Simulation sim = world("<test.sender from=\"a\" to=\"b\" size=\"" + std::to_string(size) + "\"/>");
    int arrived = 0;
    for (int tick = 0; tick < 20; ++tick) {
      const double began = sim.time();
      sim.step();
      const TableView inbox = sim.table("inbox/*/message");
      for (std::size_t i = 0; i < inbox.rows(); ++i, ++arrived) {
        EXPECT_EQ(inbox.at(i, 0), 1);
        EXPECT_EQ(inbox.at(i, 1), 0);
        EXPECT_EQ(inbox.at(i, 2), by_pair(sim, "link/*/rssi").at({"a", "b"}));
        EXPECT_LE(inbox.at(i, 3), inbox.at(i, 4));
        EXPECT_GE(inbox.at(i, 4), began);
        EXPECT_LT(inbox.at(i, 4), sim.time() + 1e-9);
        const auto blob = static_cast<std::size_t>(inbox.at(i, Incoming::payload_column));
        const std::size_t bytes = blob ? inbox.table->now().blobs[blob - 1]->size() : 0;
        EXPECT_EQ(bytes, static_cast<std::size_t>(size));
        // The sender's bytes tell the tick in which they were made.
        for (std::size_t k = 0; k < bytes; ++k) {
          const auto sent = static_cast<uint64_t>(std::ceil(inbox.at(i, 3) / 0.1 - 1e-9));
          EXPECT_EQ((*inbox.table->now().blobs[blob - 1])[k], static_cast<uint8_t>(mixed(k + sent)));
        }
      }
    }
    EXPECT_GE(arrived, 18) << size;
  }
}

TEST_P(EachNetwork, NothingArrivesWithoutALinkOrOutOfHearing) {
  Simulation sim =
      world("<test.sender name=\"s1\" from=\"a\" to=\"far\"/><test.sender name=\"s2\" from=\"b\" to=\"gone\"/>");
  for (int tick = 0; tick < 30; ++tick) {
    sim.step();
    EXPECT_EQ(sim.table("inbox/*/message").rows(), 0u);
  }
  EXPECT_GT(sim.table("radio/a/traffic").at(0, 2), 20);  // too weak
  EXPECT_GT(sim.table("radio/b/traffic").at(0, 3), 20);  // no link
}

TEST_P(EachNetwork, ARunIsTheSameBitsHoweverItIsRun) {
  Simulation straight = world(busy);
  run(straight, 50);
  for (const int workers : {2, 3}) {
    Simulation other = world(busy, workers);
    run(other, 50);
    EXPECT_EQ(straight.digest(), other.digest()) << workers;
  }
  Simulation remade = world(busy);
  while (remade.tick() < 50) {
    if (remade.tick() % 7 == 3) remade.remake("network");
    remade.step();
  }
  EXPECT_EQ(straight.digest(), remade.digest());
  Simulation first = world(busy), again = world(busy);
  run(first, 20);
  again.restore(first.snapshot());
  run(again, 30);
  EXPECT_EQ(straight.digest(), again.digest());
}

std::vector<std::string> networks() {
  std::vector<std::string> result;
  for (const auto& entry : std::filesystem::directory_iterator(MUSTER_PLUGINS_DIR)) {
    const std::string name = entry.path().stem().string();
    if (entry.path().extension() == ".so" && name.compare(0, 8, "network_") == 0)
      result.push_back("network." + name.substr(8));
  }
  return result;
}
INSTANTIATE_TEST_SUITE_P(Plugins, EachNetwork, testing::ValuesIn(networks()),
                         [](const auto& network) { return network.param.substr(8); });

}  // namespace
}  // namespace muster
