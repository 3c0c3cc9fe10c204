// Messages: each copy has one outcome, payloads arrive byte for byte, and a sender cannot forge its name.
#include <gmock/gmock.h>

#include "messages.hpp"
#include "world_of.hpp"

namespace muster {
namespace {

const std::string channel =
    "<radio.multiwall/><radio.receiver sensitivity=\"-90\"/><network.ideal sensitivity=\"-70\"/>\n";

struct Counts {
  double asked, delivered, too_weak, no_link;
  bool operator==(const Counts&) const = default;
};
Counts traffic(const Simulation& world, const std::string& radio) {
  const TableView row = world.table("radio/" + radio + "/traffic");
  return {row.at(0, 0), row.at(0, 1), row.at(0, 2), row.at(0, 3)};
}

// Strong from a: near (-40). Weak, yet received: -77 at 70 m. Below the receiver: far. Without link: beyond the range.
const std::string four = station("a", "0 0 1") + station("near", "1 0 1") + station("weak", "70 0 1") +
                         station("far", "400 0 1") + station("gone", "0 900 1") + "<radio.links range=\"600\"/>";

TEST(Network, EveryCopyHasOneOutcome) {
  const Folder folder;
  Simulation world = world_of(folder, four + channel + "<test.sender name=\"all\" from=\"a\"/>" +
                                          "<test.sender name=\"one\" from=\"a\" to=\"near\" count=\"3\"/>" +
                                          "<test.sender name=\"none\" from=\"near\" to=\"gone\"/>" +
                                          "<test.sender name=\"self\" from=\"weak\" to=\"weak\"/>");
  for (int tick = 1; tick <= 5; ++tick) {
    world.step();
    EXPECT_EQ(traffic(world, "a"), (Counts{7.0 * tick, 4.0 * tick, 2.0 * tick, 1.0 * tick}));
    EXPECT_EQ(traffic(world, "near"), (Counts{1.0 * tick, 0, 0, 1.0 * tick}));
    EXPECT_EQ(traffic(world, "weak"), (Counts{1.0 * tick, 0, 0, 1.0 * tick}));
    EXPECT_EQ(traffic(world, "far"), (Counts{0, 0, 0, 0}));
    EXPECT_EQ(world.table("inbox/*/message").rows(), 4u);
  }
}

TEST(Network, TheReceivingSideFillsInWhoHowStrongAndWhen) {
  const Folder folder;
  Simulation world = world_of(folder, four + channel + "<test.sender from=\"near\" to=\"a\"/>");
  run(world, 3);
  const TableView inbox = world.table("inbox/*/message");
  ASSERT_EQ(inbox.rows(), 1u);
  EXPECT_EQ(inbox.at(0, 0), 0);  // at radio a
  EXPECT_EQ(inbox.at(0, 1), 1);  // from near
  EXPECT_NEAR(inbox.at(0, 2), -40, 1e-12);
  EXPECT_EQ(inbox.at(0, 3), world.time());
  EXPECT_EQ(inbox.at(0, 4), world.time());
}

TEST(Network, EachMessageArrivesWithItsOwnPayload) {
  const Folder folder;
  Simulation world =
      world_of(folder, four + channel + "<test.sender name=\"there\" from=\"a\" to=\"near\" size=\"5\"/>" +
                           "<test.sender name=\"lost\" from=\"a\" to=\"far\" size=\"6\"/>" +
                           "<test.sender name=\"back\" from=\"near\" to=\"a\" size=\"7\"/>");
  run(world, 3);
  const TableView inbox = world.table("inbox/*/message");
  ASSERT_EQ(inbox.rows(), 2u);
  EXPECT_EQ(payload(world, 0), sent(5, 3));
  EXPECT_EQ(payload(world, 1), sent(7, 3));
}

TEST(Network, UsesTheLinkFromSenderToReceiver) {
  const Folder folder;
  Simulation world = world_of(folder, four + channel + "<test.deaf radio=\"a\"/>" +
                                          "<test.sender name=\"to\" from=\"near\" to=\"a\"/>" +
                                          "<test.sender name=\"from\" from=\"a\" to=\"near\"/>");
  world.step();
  EXPECT_EQ(traffic(world, "near"), (Counts{1, 0, 1, 0}));
  EXPECT_EQ(traffic(world, "a"), (Counts{1, 1, 0, 0}));
}

TEST(Network, ARadioThatLeftIsAskedNoMore) {
  const Folder folder;
  Simulation world = world_of(folder, four + channel + "<test.leaver radio=\"near\" at=\"2\"/>" +
                                          "<test.sender name=\"all\" from=\"a\"/>" +
                                          "<test.sender name=\"one\" from=\"far\" to=\"near\"/>");
  world.step();
  EXPECT_EQ(traffic(world, "a"), (Counts{4, 1, 2, 1}));
  EXPECT_EQ(traffic(world, "far"), (Counts{1, 0, 1, 0}));
  run(world, 4);
  const Counts later = traffic(world, "a"), before_last = traffic(world, "far");
  world.step();
  EXPECT_EQ(traffic(world, "a").asked, later.asked + 3);
  EXPECT_EQ(traffic(world, "a").delivered, later.delivered);
  EXPECT_EQ(traffic(world, "far").no_link, before_last.no_link);
}

}  // namespace
}  // namespace muster
