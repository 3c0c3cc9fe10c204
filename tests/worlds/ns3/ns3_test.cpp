// Rows 23 and 26 of the requirements: ns-3 behind the same messages, against our own network on one world, and as a
// network that routes by itself; and what it cannot do. What every network keeps, it keeps in tests/plugins/radio.
#include <gmock/gmock.h>

#include <cmath>
#include <map>

#include "tests/plugins/radio/world_of.hpp"

namespace muster {
namespace {

// The columns of radio/*/traffic.
enum { asked = 0, delivered, too_weak, no_link, collided, no_access, queue_full, no_ack, gone };

const std::string ns3 = "<network.ns3 name=\"network\"/>\n";
const std::string ours = "<network.lrwpan name=\"network\" cca=\"ns3\" cca_threshold=\"-96.58\" noise=\"-106.987\"/>\n";

double share(const Simulation& sim, std::size_t column) {
  const TableView traffic = sim.table("radio/*/traffic");
  double sum = 0, all = 0;
  for (std::size_t r = 0; r < traffic.rows(); ++r) sum += traffic.at(r, column), all += traffic.at(r, asked);
  return sum / all;
}

// An office: 16 radios in rooms of 10 m.
std::string office() {
  std::string result = "<material name=\"brick\" loss=\"8\"/>\n";
  for (int i = 1; i < 4; ++i) {
    const std::string at = std::to_string(10 * i), name = std::to_string(i);
    result += "<wall name=\"x" + name + "\" from=\"" + at + " 0\" to=\"" + at + " 40\" material=\"brick\"/>\n";
    result += "<wall name=\"y" + name + "\" from=\"0 " + at + "\" to=\"40 " + at + "\" material=\"brick\"/>\n";
  }
  for (int i = 0; i < 16; ++i)
    result += station("r" + std::to_string(i), std::to_string(10 * (i % 4) + 2 + 3 * (i % 3)) + ' ' +
                                                   std::to_string(10 * (i / 4) + 3 + 2 * (i % 4)) + " 1");
  return result + "<radio.multiwall n=\"3\"/><radio.receiver sensitivity=\"-150\"/>\n";
}

std::string everybody_sends(const std::string& attributes) {
  std::string result;
  for (int i = 0; i < 16; ++i)
    result +=
        "<test.sender name=\"s" + std::to_string(i) + "\" from=\"r" + std::to_string(i) + "\" " + attributes + "/>\n";
  return result;
}

class Ns3 : public testing::Test {
 protected:
  Simulation world(const std::string& elements, int workers = 1) const { return world_of(folder, elements, workers); }
  std::string error_of(const std::function<void()>& call) const {
    try {
      call();
    } catch (const Error& e) {
      EXPECT_EQ(e.exit(), Exit::invalid_input);
      return e.what();
    }
    return "no error";
  }
  const Folder folder;
};

TEST_F(Ns3, AsManyBroadcastsArriveAsInOurNetwork) {
  for (const std::string load : {"size=\"20\"", "count=\"2\" size=\"60\""}) {
    Simulation theirs = world(office() + everybody_sends(load) + ns3);
    Simulation our_own = world(office() + everybody_sends(load) + ours);
    run(theirs, 400), run(our_own, 400);
    std::printf("delivered %.4f (%.4f), no access %.4f (%.4f)\n", share(our_own, delivered), share(theirs, delivered),
                share(our_own, no_access), share(theirs, no_access));
    EXPECT_NEAR(share(our_own, delivered), share(theirs, delivered), 0.01);
    EXPECT_NEAR(share(our_own, no_access), share(theirs, no_access), 0.01);
    EXPECT_LT(share(theirs, delivered), 0.98);
    EXPECT_GT(share(theirs, delivered), 0.3);
  }
}

TEST_F(Ns3, AsManyAcknowledgedMessagesArriveAsInOurNetwork) {
  Simulation theirs = world(office() + everybody_sends("to=\"r5\" size=\"80\"") + ns3);
  Simulation our_own = world(office() + everybody_sends("to=\"r5\" size=\"80\"") + ours);
  run(theirs, 600), run(our_own, 600);
  std::printf("delivered %.4f (%.4f), no access %.4f (%.4f)\n", share(our_own, delivered), share(theirs, delivered),
              share(our_own, no_access), share(theirs, no_access));
  EXPECT_NEAR(share(our_own, delivered), share(theirs, delivered), 0.02);
}

TEST_F(Ns3, InNoiseTheSameShareArrivesAtEachDistance) {
  for (const int distance : {165, 180, 190}) {
    const std::string two =
        station("a", "0 0 1") + station("b", std::to_string(distance) + " 0 1") +
        "<radio.links range=\"600\"/><radio.multiwall n=\"3\"/><radio.receiver sensitivity=\"-150\"/>"
        "<test.sender from=\"a\" count=\"2\" size=\"40\"/>\n";
    Simulation theirs = world(two + ns3), our_own = world(two + ours);
    run(theirs, 900), run(our_own, 900);
    std::printf("%d m: %.4f (%.4f)\n", distance, share(our_own, delivered), share(theirs, delivered));
    EXPECT_NEAR(share(our_own, delivered), share(theirs, delivered), 0.05);  // three deviations of 1800 messages
  }
}

// ---- Personal area networks -----------------------------------------------------------------------------------------

// Every other radio is in another PAN than the rest.
const std::string two_pans = "<radio.pan name=\"even\" id=\"4660\" radios=\"r0 r2 r4 r6 r8 r10 r12 r14\"/>\n";

TEST_F(Ns3, InTwoPansAsMuchArrivesAsInOurNetwork) {
  for (const std::string load : {"count=\"2\" size=\"60\"", "to=\"r5\" size=\"80\""}) {
    Simulation theirs = world(office() + two_pans + everybody_sends(load) + ns3);
    Simulation our_own = world(office() + two_pans + everybody_sends(load) + ours);
    run(theirs, 600), run(our_own, 600);
    for (const auto column : {delivered, no_link, no_access}) {
      std::printf("%d: %.4f (%.4f)\n", column, share(our_own, column), share(theirs, column));
      EXPECT_NEAR(share(our_own, column), share(theirs, column), 0.02);
    }
  }
}

// A frame from one PAN to another is two octets longer. What arrives has waited for whole back-off periods beside.
TEST_F(Ns3, FramesAreAsLongAsInOurNetwork) {
  const auto beyond_periods = [&](const std::string& network, const std::string& pans) {
    Simulation sim =
        world(station("a", "0 0 1") + station("b", "3 0 1") +
              "<radio.multiwall n=\"3\"/><test.sender from=\"a\" to=\"b\" only=\"1\" size=\"60\"/>\n" + pans + network);
    for (int tick = 0; tick < 5 && sim.table("inbox/*/message").rows() == 0; ++tick) sim.step();
    const TableView inbox = sim.table("inbox/*/message");
    return inbox.rows() == 1 ? std::fmod(1e6 * (inbox.at(0, 4) - inbox.at(0, 3)), 320) : -1;
  };
  const std::string one = "<radio.pan id=\"7\" radios=\"b\"/>\n";
  for (const std::string& network : {ns3, ours}) {
    EXPECT_NEAR(beyond_periods(network, ""), (192 + 128 + 32 * (6 + 11 + 60)) % 320, 0.1);
    EXPECT_NEAR(beyond_periods(network, one), (192 + 128 + 32 * (6 + 13 + 60)) % 320, 0.1);
  }
}

// ---- Routing by ns-3 ------------------------------------------------------------------------------------------------

// Radios r0, r1, ... 10 m apart, of which each hears its neighbours only, and a message from the first.
std::string chain(int radios, const std::string& message, int missing = -1) {
  std::string result;
  for (int i = 0; i < radios; ++i)
    if (i != missing) result += station('r' + std::to_string(i), std::to_string(10 * i) + " 0 1");
  return result + "<radio.links range=\"600\"/><radio.multiwall n=\"3\"/><radio.receiver sensitivity=\"-73.5\"/>" +
         "<test.sender name=\"s\" from=\"r0\" only=\"1\" " + message + "/>\n";
}
const std::string mesh = "<network.ns3 name=\"network\" routing=\"mesh\"/>\n";

double of_first(const Simulation& sim, std::size_t column) { return sim.table("radio/r0/traffic").at(0, column); }

// Runs so many ticks. Who got the message of the first as it was sent in tick 1, radio by radio: r12, say.
std::string who_got_it(Simulation& sim, int ticks, std::size_t size) {
  std::string result = "r";
  for (int tick = 0; tick < ticks; ++tick) {
    sim.step();
    const TableView inbox = sim.table("inbox/*/message");
    const Cells& cells = inbox.table->now();
    for (std::size_t row = 0; row < inbox.rows(); ++row) {
      if (cells.appended[row] != sim.tick()) continue;
      EXPECT_EQ(inbox.at(row, 1), 0) << "from another radio";
      EXPECT_NEAR(inbox.at(row, 2), -70, 1) << "rssi is that of the last hop, of 10 m";
      const auto blob = static_cast<std::size_t>(inbox.at(row, Incoming::payload_column));
      const auto& bytes = *cells.blobs.at(blob - 1);
      EXPECT_EQ(bytes.size(), size);
      for (std::size_t i = 0; i < size; ++i) EXPECT_EQ(static_cast<char>(bytes[i]), static_cast<char>(mixed(i + 1)));
      result += std::to_string(static_cast<int>(inbox.at(row, 0)));
    }
  }
  return result;
}

TEST_F(Ns3, Row23OnlyItsMeshReachesWhoIsOutOfHearing) {
  const auto reached = [&](const std::string& to, const std::string& network) {
    Simulation sim = world(chain(5, to + " size=\"20\"") + network);
    return who_got_it(sim, 30, 20);
  };
  EXPECT_EQ(reached("to=\"r4\"", ns3), "r");
  EXPECT_EQ(reached("to=\"r4\"", mesh), "r4");
  EXPECT_EQ(reached("", ns3), "r1");
  EXPECT_EQ(reached("", mesh), "r1234");
}

// Nobody acknowledges, so that what is passed on must not meet what is still to come.
TEST_F(Ns3, Row23ItsMeshPutsLongMessagesTogether) {
  const auto reached = [&](int radios, const std::string& to, std::size_t size) {
    Simulation sim = world(chain(radios, to + " size=\"" + std::to_string(size) + "\"") + mesh);
    return who_got_it(sim, 60, size);
  };
  EXPECT_EQ(reached(2, "", 0), "r1");
  EXPECT_EQ(reached(3, "to=\"r2\"", 300), "r2") << "in fragments";
  EXPECT_EQ(reached(2, "to=\"r1\"", 5000), "r1") << "in packets";
}

// The same message by a routing of ours on ns-3's network and on our own.
TEST_F(Ns3, Row23RoutingsOfOursReachThemToo) {
  const std::string to = "to=\"r4\" size=\"20\"";
  for (const std::string routing : {"routing.flooding", "routing.aodv"}) {
    for (const std::string& network : {ns3, ours}) {
      Simulation sim = world(chain(5, to) + network + "<" + routing + " name=\"routing\"/>\n");
      EXPECT_EQ(who_got_it(sim, 100, 20), "r4") << routing;
    }
  }
}

TEST_F(Ns3, ItsMeshTakesSoManyHopsAndNoMore) {
  for (const auto& [hops, reached] : std::map<int, std::string>{{3, "r123"}, {4, "r1234"}}) {
    Simulation sim = world(chain(5, "") + "<network.ns3 name=\"network\" routing=\"mesh\" hops=\"" +
                           std::to_string(hops) + "\"/>\n");
    EXPECT_EQ(who_got_it(sim, 30, 16), reached);
  }
}

TEST_F(Ns3, ItsMeshStaysInItsPan) {
  for (const std::string to : {"", "to=\"r2\""}) {
    Simulation sim = world(chain(3, to) + "<radio.pan id=\"1\" radios=\"r2\"/>\n" + mesh);
    EXPECT_EQ(who_got_it(sim, 130, 16), to.empty() ? "r1" : "r");
    EXPECT_EQ(of_first(sim, no_link), 1);
  }
}

// Ten seconds after its last frame a copy that has not come is lost.
TEST_F(Ns3, EachCopyInItsMeshHasOneOutcome) {
  Simulation sim = world(chain(5, "", 3) + mesh);
  EXPECT_EQ(who_got_it(sim, 90, 16), "r12");
  EXPECT_EQ(of_first(sim, asked), 3);
  EXPECT_EQ(of_first(sim, delivered), 2);
  EXPECT_EQ(of_first(sim, collided) + of_first(sim, no_link), 0) << "too early";
  run(sim, 30);
  EXPECT_EQ(of_first(sim, no_link), 1) << "it hears nobody";
}

// The flood of many messages at once fills the air: some are lost, none twice, and the counts add up.
TEST_F(Ns3, AMeshUnderLoadLosesMessagesAndCountsThem) {
  std::string senders;
  for (int i = 0; i < 5; ++i)
    senders += "<test.sender name=\"t" + std::to_string(i) + "\" from=\"r" + std::to_string(i) + "\" to=\"r" +
               std::to_string((i + 3) % 5) + "\" count=\"3\" size=\"80\"/>\n" + "<swap at=\"3\" instance=\"t" +
               std::to_string(i) + "\" plugin=\"test.sender\" from=\"r0\" count=\"0\"/>\n";
  Simulation sim = world(chain(5, "count=\"0\"") + senders + mesh);
  run(sim, 600);
  const TableView traffic = sim.table("radio/*/traffic");
  for (std::size_t r = 0; r < traffic.rows(); ++r) {
    double ended = 0;
    for (const auto column : {delivered, too_weak, no_link, collided, no_access, queue_full, no_ack, gone})
      ended += traffic.at(r, column);
    EXPECT_EQ(ended, traffic.at(r, asked));
    EXPECT_GE(traffic.at(r, asked), 85);
  }
  EXPECT_GT(share(sim, delivered), 0.2);
  EXPECT_LT(share(sim, delivered), 0.95);
}

// ---- What it cannot do ----------------------------------------------------------------------------------------------

const std::string pair =
    station("a", "0 0 1") + station("b", "5 0 1") + "<radio.multiwall n=\"3\"/><test.sender name=\"s\" from=\"a\"/>\n";

// Toys in its phase have it stepped by threads that change.
TEST_F(Ns3, ARunIsTheSameForAnyNumberOfWorkers) {
  std::string toys;
  for (const std::string name : {"t1", "t2", "t3"}) toys += "<toy.listen_network name=\"" + name + "\"/>\n";
  const auto digest = [&](int workers) {
    Simulation sim = world(office() + toys + everybody_sends("size=\"30\"") + ns3, workers);
    run(sim, 30);
    return sim.digest();
  };
  const auto alone = digest(1);
  EXPECT_EQ(alone, digest(1));
  EXPECT_EQ(alone, digest(3));
}

TEST_F(Ns3, CannotBeRestored) {
  Simulation sim = world(pair + ns3);
  run(sim, 5);
  const Snapshot middle = sim.snapshot();
  run(sim, 5);
  sim.restore(middle);
  EXPECT_THAT(error_of([&] { sim.step(); }), testing::HasSubstr("network (network.ns3): step failed at tick 6"));
  EXPECT_THAT(
      error_of([&] { sim.step(); }),
      testing::HasSubstr("the simulator behind this network keeps its state to itself and cannot be restored: it "
                         "has done 10 ticks of its own, the run goes on after 5 ticks of another past; expected a "
                         "run from its start"));
}

TEST_F(Ns3, CannotBeMadeAnewInMidRun) {
  Simulation sim = world(pair + ns3);
  run(sim, 5);
  sim.remake("network");
  EXPECT_THAT(error_of([&] { sim.step(); }), testing::HasSubstr("it has done 0 ticks of its own"));
}

TEST_F(Ns3, TakesOverFromAnotherNetworkInMidRun) {
  Simulation sim = world(pair + ours + "<swap at=\"1\" instance=\"network\" plugin=\"network.ns3\"/>\n");
  run(sim, 30);
  EXPECT_GE(sim.table("radio/a/traffic").at(0, delivered), 28);
}

TEST_F(Ns3, HoldsOneSimulationAProcess) {
  {
    Simulation one = world(pair + ns3), two = world(pair + ns3);
    one.step();
    EXPECT_THAT(error_of([&] { two.step(); }),
                testing::HasSubstr("network (network.ns3): ns-3 holds one simulation a "
                                   "process, and another instance has it; expected one network.ns3"));
    one.step();
  }
  Simulation next = world(pair + ns3);
  run(next, 10);
  EXPECT_GE(next.table("radio/a/traffic").at(0, delivered), 9);
}

}  // namespace
}  // namespace muster
