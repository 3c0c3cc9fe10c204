// Words of a command line that are nearly right: the message says what was meant.
#include <gmock/gmock.h>

#include "program.hpp"

using namespace muster::test;
using testing::HasSubstr;

namespace {

std::string words_said_by(const std::vector<std::string>& words) {
  const ProgramFolder folder;
  folder.write("world.xml", R"(<world name="w" dt="1" until="2"><station name="a" at="0 0 1"/></world>)");
  folder.write("m.csv", "t[s],tx,rx\n0,a,b\n");
  folder.write("plan.dxf", "0\nSECTION\n");
  const Outcome outcome = folder.muster(words);
  EXPECT_EQ(outcome.exit, 2) << outcome.out;
  return outcome.err;
}

TEST(CommandWords, SayWhatWasMeant) {
  EXPECT_THAT(words_said_by({"fit", "world.xml", "m.csv"}),
              HasSubstr("\"m.csv\" is one word too many, and --data is missing; did "
                        "you mean --data m.csv?"));
  EXPECT_THAT(words_said_by({"run", "world.xml", "world.xml"}),
              HasSubstr("one word too many: run takes one world; muster compare A B runs two"));
  EXPECT_THAT(words_said_by({"run", "World.xml"}), HasSubstr("World.xml: no such file; did you mean \"world.xml\"?"));
  EXPECT_THAT(words_said_by({"probe", "world.xml", "a", "b", "--at", "500"}),
              HasSubstr("--at: 500 s is after the end of the run at 2 s; expected at most 2 s"));
  EXPECT_THAT(words_said_by({"map", "world.xml", "--out", "m", "--at", "500"}), HasSubstr("expected at most 2 s"));
  EXPECT_THAT(words_said_by({"compare", "world.xml", "world.xml", "--within", "0.05"}),
              HasSubstr("such as pose/distance=0.05"));
  EXPECT_THAT(words_said_by({"log", "info", "m.csv"}), HasSubstr("m.csv: is a table already; expected an MCAP file"));
  EXPECT_THAT(words_said_by({"check", "world.xml", "--plugins", "m.csv"}),
              HasSubstr("\"m.csv\" is no folder, but a file; expected its folder, \".\""));
}

}  // namespace
