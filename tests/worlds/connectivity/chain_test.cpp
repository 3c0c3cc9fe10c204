// What observe.chain refuses: chains in which its columns would not be told apart.
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
  const std::string begin = "world.xml:2:1: observe.chain (observe.chain): create failed: ";
  const std::string end = "; expected each radio once, from the nearest to the base to the furthest";
  EXPECT_EQ(refusal("a b a"), begin + "chain=\"a b a\" names \"a\" twice" + end);
  EXPECT_EQ(refusal("a b b"), begin + "chain=\"a b b\" names \"b\" twice" + end);
  EXPECT_EQ(refusal("a a"), begin + "chain=\"a a\" names \"a\" twice" + end);
  EXPECT_EQ(refusal("a, b"),
            begin + "chain: \"a,\" is no radio of this world; names stand between blanks, without commas");
  EXPECT_EQ(refusal("a c-1 c.1", "c-1"),
            begin + "chain: both \"c-1\" and \"c.1\" would give the column level_c_1; rename one of these radios");
  EXPECT_EQ(refusal("a b c.1"), "not refused");
}

}  // namespace
