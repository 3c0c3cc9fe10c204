// Membership of a piconet in a world. tests/README.md lists the rows.
#include <gmock/gmock.h>

#include "world_of.hpp"

namespace muster {
namespace {

const std::string channel = "<radio.multiwall n=\"3\"/><radio.receiver sensitivity=\"-90\"/>\n";

std::string stations(int count) {
  std::string result;
  for (int i = 0; i < count; ++i)
    result += station(std::string(1, static_cast<char>('a' + i)), std::to_string(i) + " 1 1");
  return result;
}

const std::string talk = "<test.sender from=\"a\"/>";

TEST(Piconet, Row24AnEighthSlaveIsRefused) {
  const Folder folder;
  Simulation seven = world_of(folder, stations(8) + channel + talk + "<network.bluetooth/>");
  run(seven, 3);
  Simulation eight = world_of(folder, stations(9) + channel + talk + "<network.bluetooth/>");
  try {
    eight.step();
    FAIL() << "not refused";
  } catch (const Error& refused) {
    EXPECT_THAT(refused.what(), testing::HasSubstr("network.bluetooth (network.bluetooth): 9 radios; a piconet has one "
                                                   "master and at most 7 slaves; expected 8 radios or fewer"));
  }
}

// The run is in the state before.
TEST(Piconet, Row24AnEighthSlaveThatJoinsIsRefused) {
  const Folder folder;
  Simulation sim = world_of(
      folder, stations(8) + channel + talk + "<network.bluetooth/><test.joiner radio=\"late\" like=\"a\" at=\"5\"/>");
  EXPECT_THROW(run(sim, 10), Error);
  EXPECT_EQ(sim.tick(), 5u);
}

TEST(Piconet, AJammersRadioIsNotOfIt) {
  const Folder folder;
  Simulation sim = world_of(folder, stations(9) + channel +
                                        "<network.bluetooth master=\"c\"/><radio.jammer radio=\"i\" excess=\"-100\"/>" +
                                        "<test.sender from=\"c\"/>");
  run(sim, 20);
  const TableView traffic = sim.table("radio/c/traffic");
  EXPECT_EQ(traffic.at(0, 0), 8 * 20);
  EXPECT_EQ(traffic.at(0, 3), 20);  // no link to it
  EXPECT_GE(traffic.at(0, 1), 7 * 19);
}

// The first radio was the master also where it jammed or had left, and nothing was delivered.
TEST(Piconet, TheMasterIsTheFirstRadioThatIsThereAndDoesNotJam) {
  const Folder folder;
  const std::string three = stations(3) + channel + "<network.bluetooth/><test.sender from=\"b\" to=\"c\"/>";
  Simulation jammed = world_of(folder, three + "<radio.jammer radio=\"a\" excess=\"-100\"/>");
  run(jammed, 20);
  EXPECT_EQ(jammed.table("radio/b/traffic").at(0, 0), 20);
  EXPECT_GE(jammed.table("radio/b/traffic").at(0, 1), 19);
  Simulation left = world_of(folder, three + "<at t=\"1\"><leave station=\"a\"/></at>");
  run(left, 30);
  EXPECT_GE(left.table("radio/b/traffic").at(0, 1), 18);
}

TEST(Piconet, AMasterThatJamsIsRefused) {
  const Folder folder;
  Simulation sim = world_of(folder, stations(2) + channel + talk + "<network.bluetooth master=\"b\"/>" +
                                        "<radio.jammer radio=\"b\" excess=\"-100\"/>");
  try {
    run(sim, 2);
    FAIL() << "not refused";
  } catch (const Error& refused) {
    EXPECT_THAT(refused.what(), testing::HasSubstr("attribute \"master\": \"b\" jams, so that it is no radio of the "
                                                   "piconet; expected one that does not jam, of a"));
    EXPECT_THAT(refused.what(), testing::Not(testing::HasSubstr("of a, b")));
  }
}

}  // namespace
}  // namespace muster
