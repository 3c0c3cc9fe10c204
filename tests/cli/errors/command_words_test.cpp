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

// A world with a channel, so that there are parameters and instances to name.
std::string said_beside_a_channel(const std::vector<std::string>& words) {
  const ProgramFolder folder;
  folder.write("lab/world.xml",
               R"(<world name="w" dt="1" until="2"><station name="a" at="0 0 1"/><station name="b" at="4 0 1"/>)"
               R"(<radio.multiwall name="channel"/></world>)");
  folder.write("m.csv", "t[s],tx,rx,rssi[dBm]\n0,a,b,-50\n");
  folder.write("sweep.xml", R"(<sweep world="lab" seeds="1"><vary set="channel/n" values="2,3,4"/></sweep>)");
  EXPECT_EQ(folder.muster({"run", "lab", "--save", "early"}).exit, 0);
  const Outcome outcome = folder.muster(words);
  EXPECT_EQ(outcome.exit, 2) << outcome.out;
  return outcome.err;
}

TEST(CommandWords, ByThePluginInPlaceOfTheInstance) {
  EXPECT_EQ(said_beside_a_channel({"run", "lab", "--set", "radio.multiwall/n=3"}),
            "muster: error: there is no parameter \"radio.multiwall/n\"; radio.multiwall is the plugin of "
            "\"channel\"; did you mean \"channel/n\"?\n");
  EXPECT_THAT(
      said_beside_a_channel({"swap", "lab", "--at", "1", "--instance", "radio.multiwall", "--plugin", "test.good"}),
      HasSubstr("--instance: no instance is called \"radio.multiwall\"; expected channel; radio.multiwall is the "
                "plugin of \"channel\"\n"));
}

TEST(CommandWords, AParameterByItsMeaning) {
  EXPECT_THAT(
      said_beside_a_channel({"run", "lab", "--set", "channel/exponent=3"}),
      HasSubstr("there is no parameter \"channel/exponent\"; expected one of channel/tx_power, channel/l0, channel/n, "
                "channel/model, channel/radius; did you mean \"channel/n\"?"));
  EXPECT_THAT(
      said_beside_a_channel({"run", "lab", "--set", "channel=3"}),
      HasSubstr("there is no parameter \"channel\"; it has several: expected one of channel/tx_power, channel/l0"));
}

TEST(CommandWords, AFolderOfWorldsAndArgumentsExchanged) {
  EXPECT_EQ(said_beside_a_channel({"check", "."}),
            "muster: error: ./world.xml: no such file; it holds the world \"./lab\"\n");
  EXPECT_EQ(said_beside_a_channel({"fit", "m.csv", "--data", "lab"}),
            "muster: error: muster fit: --data lab is the folder of a world; expected muster fit lab --data TABLE\n");
  EXPECT_EQ(said_beside_a_channel({"compare", "lab", "channel:radio.friis"}),
            "muster: error: muster compare: \"channel:radio.friis\" is no world; expected INSTANCE=PLUGIN, "
            "channel=radio.friis\n");
}

TEST(CommandWords, ATableWithoutItsColumn) {
  EXPECT_EQ(said_beside_a_channel({"run", "lab", "--out", "o", "--plot", "radio/a/mount"}),
            "muster: error: --plot \"radio/a/mount\" has no column; expected one of the table's, such as "
            "\"radio/a/mount/robot\"\n");
}

TEST(CommandWords, ListsWithCommasCornersAndPlugins) {
  EXPECT_EQ(
      said_beside_a_channel({"sweep", "sweep.xml", "--out", "o"}),
      "muster: error: sweep.xml:1:60: values: \"2,3,4\" is not a number; expected numbers with blanks between them, "
      "and a point in each: \"1.5 2 2.5\"\n");
  EXPECT_EQ(said_beside_a_channel({"map", "lab", "--out", "o", "--area", "0", "12", "0", "8"}),
            "muster: error: --area: 0 12 0 8: X0 and X1 are both 0; expected X0 Y0 X1 Y1, two corners, X0 < X1 "
            "and Y0 < Y1; did you mean --area 0 0 12 8? (from its order X0 X1 Y0 Y1)\n");
  EXPECT_EQ(said_beside_a_channel({"describe", "multiwall"}),
            "muster: error: there is no element \"multiwall\", and a plugin has a dot in its name; expected "
            "radio.multiwall\n");
}

TEST(CommandWords, AStateAfterTheEnd) {
  EXPECT_EQ(
      said_beside_a_channel({"run", "lab", "--restore", "early", "--until", "1"}),
      "muster: error: --restore: early stands at 2 s, after the end of the run at 1 s; expected --until above 2: it "
      "is a time of the world, not a duration\n");
}

}  // namespace
