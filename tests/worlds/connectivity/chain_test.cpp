// What observe.chain refuses, chains in which its columns would not be told apart; and the time constant that it
// measures.
#include "chain.hpp"

namespace {

using namespace muster;
using namespace muster::test;

std::string refusal(const std::string& chain, const std::string& second = "b") {
  Folder folder;
  try {
    world_of(folder, "<station name=\"a\" at=\"0 0 1\"/><station name=\"" + second +
                         "\" at=\"1 0 1\"/><station name=\"c.1\" at=\"2 0 1\"/>\n<observe.chain chain=\"" + chain +
                         "\"/><radio.multiwall/>");
  } catch (const Error& e) {
    const std::string what = e.what();
    return what.substr(what.rfind("world.xml"));
  }
  return "not refused";
}

TEST(Chain, NamesEachRadioOnce) {
  const std::string begin = "world.xml:2:23: attribute \"chain\": ";
  const std::string end = "; expected each radio once, from the nearest to the base to the furthest";
  EXPECT_EQ(refusal("a b a"), begin + "\"a b a\" names \"a\" twice" + end);
  EXPECT_EQ(refusal("a b b"), begin + "\"a b b\" names \"b\" twice" + end);
  EXPECT_EQ(refusal("a a"), begin + "\"a a\" names \"a\" twice" + end);
  EXPECT_EQ(refusal("a, b"), begin + "\"a, b\" has commas between its names; expected blanks: chain=\"a b\"");
  EXPECT_EQ(refusal("a,b"), begin + "\"a,b\" has commas between its names; expected blanks: chain=\"a b\"");
  EXPECT_EQ(refusal("a d"), begin + "no radio is called \"d\"; expected some of a, b, c.1");
  EXPECT_EQ(refusal("a"), begin +
                              "\"a\" has no link; expected two names or more, with blanks between, from the base "
                              "outwards");
  EXPECT_EQ(refusal("a c-1 c.1", "c-1"),
            begin + "both \"c-1\" and \"c.1\" would give the column level_c_1; rename one of these radios");
  EXPECT_EQ(refusal("a b c.1"), "not refused");
}

struct OneLink {
  ChainLink link;
};

// A leader alone in a channel of -30 dBm - 2 dB/m, from 6 m off, where its speed is still in proportion to the rssi.
OneLink approached(const std::string& chain_smoothing, const std::string& until) {
  Folder folder;
  Simulation run = world_of(folder,
                            "<station name='base' at='0 0 0.3'/><robot name='leader' at='6 0 0' antenna='0 0 0.3'/>"
                            "<physics.planar/><robots.drive/><robots.odometry/><test.slope slope='2'/><network.ideal/>"
                            "<control.beacon radio='base' period='0.1'/>"
                            "<control.connectivity name='steer' robot='leader' roadmap='way.csv' parent='base' "
                            "role='leader' width='20' speed='0.3' smoothing='1'/>"
                            "<observe.chain name='chain' chain='base leader' smoothing='" +
                                chain_smoothing + "'/>",
                            {{"way.csv", "x[m],y[m]\n0,0\n60,0\n"}}, "dt='0.02' until='" + until + "' seed='1'");
  while (!run.done()) run.step();
  return row<OneLink>(run, "instance/chain/chain");
}

// Average residence times add: width / (speed slope) of the loop, less the lag of the controller's filter, which starts
// at the first reading, plus that of the observer's.
TEST(Chain, TheTimeConstantIsThatOfTheLoop) {
  const double loop = 20 / (0.3 * 2), controller = 1;
  EXPECT_NEAR(approached("0", "400").link.constant, loop - controller, 0.01 * loop);
  EXPECT_NEAR(approached("5", "400").link.constant, loop - controller + 5, 0.01 * loop);
  EXPECT_NEAR(approached("0", "60").link.constant, loop, 0.05 * loop) << "on the way as well";
  EXPECT_TRUE(std::isnan(approached("0", "1").link.constant)) << "it has hardly moved";
}

TEST(Chain, TheShareOfTimeBelow) {
  const ChainLink link = approached("0", "400").link;
  EXPECT_EQ(link.below, 0);
  EXPECT_EQ(link.share, 0);
}

// A silent link was not below, and its share fell.
TEST(Chain, ASilentLinkIsBelow) {
  Folder folder;
  Simulation run =
      world_of(folder,
               "<station name='a' at='0 0 1'/><station name='b' at='1 0 1'/><test.slope name='hill'/>"
               "<control.beacon radio='a' period='0.1'/><network.ideal/><observe.chain name='chain' chain='a b'/>"
               "<at t='1'><set path='hill/slope' value='100'/></at>",
               {}, "dt='0.05' until='4' seed='1'");
  while (!run.done()) run.step();
  const ChainLink link = row<OneLink>(run, "instance/chain/chain").link;
  EXPECT_LT(link.level, -95) << "the receiver's sensitivity";
  EXPECT_NEAR(link.below, 3, 0.11);
  EXPECT_NEAR(link.share, 0.75, 0.03);
  EXPECT_GT(link.worst, -32);
}

}  // namespace
