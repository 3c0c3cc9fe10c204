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
  EXPECT_THAT(words_said_by({"run", "--wide", "world.xml", "--out", "x"}),
              HasSubstr("; --wide takes \"world.xml\"; expected world.xml --wide TEXT"));
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

TEST(CommandWords, ANameOfAnotherKind) {
  const ProgramFolder folder;
  folder.write("world.xml",
               "<world dt=\"0.1\" until=\"1\">\n<station name=\"base\" at=\"0 0 1\"/>\n"
               "<station name=\"far\" at=\"5 0 1\"/>\n<radio.multiwall name=\"channel\"/>\n"
               "</world>");
  const auto said = [&](const std::vector<std::string>& words) { return folder.muster(words).err; };
  EXPECT_THAT(said({"swap", "world.xml", "--at", "0.5", "--instance", "base", "--plugin", "test.good"}),
              HasSubstr("--instance: no instance is called \"base\", which is a station (world.xml:2:1); expected"));
  EXPECT_THAT(said({"probe", "world.xml", "base", "channel"}),
              HasSubstr("is called \"channel\", which is an instance of radio.multiwall (world.xml:4:1); expected"));
  EXPECT_THAT(said({"run", "world.xml", "--set", "base/n=3"}),
              HasSubstr("it begins with \"base\", which is a station (world.xml:2:1)"));
  EXPECT_THAT(said({"run", "world.xml", "--record", "robot/base/pose", "--out", "out"}), HasSubstr("base"));
}

// Parameters are of plugins: of a robot, those of the controller that drives it.
TEST(CommandWords, AParameterOfARobotIsThatOfItsController) {
  const ProgramFolder folder;
  folder.write("world.xml",
               "<world dt=\"0.1\" until=\"1\">\n<robot name=\"rover\" at=\"0 0 0\"/>\n"
               "<physics.planar through_walls=\"true\"/><robots.drive/>\n"
               "<control.steady name=\"driver\" robot=\"rover\" v=\"0.1\"/>\n</world>");
  expect_error(folder.muster({"run", "world.xml", "--set", "rover/v=0.2"}), 2,
               "\"rover\" is a robot (world.xml:2:1) and has no parameters; did you mean \"driver/v\", of its "
               "controller control.steady?");
  expect_error(folder.muster({"run", "world.xml", "--set", "rover/speed=0.2"}), 2,
               "\"rover\" is a robot (world.xml:2:1) and has no parameters; its controller control.steady has "
               "driver/v, driver/w, driver/until");
}

TEST(CommandWords, ACheckStandsAlone) {
  expect_error(
      ProgramFolder().muster({"diagnose", "world.xml", "--data", "d.csv", "--check", "out"}), 2,
      "muster diagnose: --check goes with --plugins and --json alone, as its folder has the world and the data; "
      "expected muster diagnose --check out; see muster diagnose --help");
}

TEST(CommandWords, AWorldInThePlaceOfADiagnosis) {
  const ProgramFolder folder;
  folder.write("lab/world.xml", "<world dt=\"0.1\" until=\"1\"/>");
  folder.write("notes/a.txt", "");
  const std::string expected = "; expected the FOLDER that muster diagnose WORLD --data FILE --out FOLDER wrote";
  expect_error(folder.muster({"diagnose", "--check", "lab"}), 2,
               "--check: lab is the folder of a world, and of no diagnosis" + expected);
  expect_error(folder.muster({"diagnose", "--check", "notes"}), 2, "--check: notes is no diagnosis" + expected);
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
  EXPECT_EQ(said_beside_a_channel({"compare", "lab", "channel=radio.friis:power=2,gain_tx=3:model=a,b"}),
            "muster: error: \"power=2,gain_tx=3\": a comma stands between attributes; expected ':' there: "
            "channel=radio.friis:power=2:gain_tx=3:model=a,b\n");
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

TEST(CommandWords, AnOptionOfAnotherVerb) {
  EXPECT_THAT(
      words_said_by({"check", "world.xml", "--set", "a/b=1"}),
      testing::StartsWith("muster: error: muster check: there is no option \"--set\" (an option of run, swap, "));
  EXPECT_THAT(words_said_by({"plugins", "--until", "1"}), HasSubstr("\"--until\" (an option of run, swap, compare"));
}

TEST(CommandWords, AnAttributeAsAnOption) {
  EXPECT_THAT(
      words_said_by({"swap", "world.xml", "--at", "1", "--instance", "a", "--plugin", "b.c", "--step", "0.002"}),
      testing::StrEq("muster: error: muster swap: there is no option \"--step\"; attributes of the new plugin are "
                     "words without dashes: step=0.002; see muster swap --help\n"));
  EXPECT_THAT(
      words_said_by({"run", "world.xml", "--loss=4"}),
      testing::StrEq("muster: error: muster run: there is no option \"--loss\"; a parameter of a plugin or of the "
                     "world is --set INSTANCE/loss=4; see muster run --help\n"));
  EXPECT_THAT(words_said_by({"run", "world.xml", "--free", "n"}), HasSubstr("\"--free\" (an option of fit); "));
  EXPECT_THAT(words_said_by({"run", "world.xml", "--duration", "4"}),
              HasSubstr("; did you mean \"--until\"? expected"));
}

TEST(CommandWords, ListsWithCommas) {
  EXPECT_EQ(said_beside_a_channel({"run", "lab", "--set", "channel/n=2,channel/l0=40"}),
            "muster: error: --set takes one parameter each time; expected --set channel/n=2 --set channel/l0=40\n");
  EXPECT_EQ(
      said_beside_a_channel({"run", "lab", "--out", "o", "--record", "robot/*/pose,radio/*/traffic"}),
      "muster: error: --record takes one table each time; expected --record robot/*/pose --record radio/*/traffic\n");
}

TEST(CommandWords, AVerbThatIsAnOptionOfRun) {
  EXPECT_EQ(
      words_said_by({"view", "world.xml"}),
      "muster: error: there is no verb \"view\"; to watch a run: muster run world.xml --view (muster --help lists "
      "the verbs)\n");
  EXPECT_THAT(words_said_by({"record"}), HasSubstr("muster run WORLD --mcap run.mcap"));
  EXPECT_THAT(words_said_by({"validate", "world.xml"}), HasSubstr("did you mean \"check\"?"));
}

TEST(CommandWords, TimesAndLengthsWithUnits) {
  EXPECT_EQ(words_said_by({"run", "world.xml", "--until", "1min"}),
            "muster: error: --until: \"1min\" is not a number; \"min\" follows the number: units are fixed and not "
            "written; expected seconds: --until 60\n");
  EXPECT_THAT(words_said_by({"run", "world.xml", "--until", "00:01:30"}), HasSubstr("expected seconds: --until 90\n"));
  EXPECT_THAT(words_said_by({"run", "world.xml", "--until", "long"}), HasSubstr("is not a number; expected seconds\n"));
  EXPECT_THAT(words_said_by({"map", "world.xml", "--out", "m", "--height", "150cm"}),
              HasSubstr("expected metres: --height 1.5\n"));
}

TEST(CommandWords, ASweepUntilATimeWithAUnit) {
  const ProgramFolder folder;
  folder.write("world.xml", world_of(""));
  folder.write("s.xml", R"(<sweep world="world.xml" seeds="1" until="1min"/>)");
  expect_error(folder.muster({"sweep", "s.xml", "--out", "o"}), 2,
               "s.xml:1:43: until: \"1min\" is not a number; \"min\" follows the number: units are fixed and not "
               "written; expected seconds; 1min are 60 s");
}

TEST(CommandWords, ABundleInThePlaceOfAWorld) {
  const ProgramFolder folder;
  folder.write("b.tar.zst", "\x28\xB5\x2F\xFD....");
  folder.write("renamed", "\x28\xB5\x2F\xFD....");
  for (const std::string name : {"b.tar.zst", "renamed"})
    expect_error(folder.muster({"bundle", name, "--out", "c.tar.zst"}), 2,
                 name + " is a bundle, and no world; did you mean muster bundle check " + name + "?");
  folder.write("world.xml", world_of(""));
  for (const std::string name : {"world.xml", "."})
    expect_error(
        folder.muster({"bundle", "check", name}), 2,
        name + " is a world, and no bundle; expected muster bundle " + name + " --out NAME.tar.zst, which makes one");
  expect_error(folder.muster({"run", "b.tar.zst"}), 2,
               "b.tar.zst: is compressed by zstd; expected plain text, or of a bundle of muster: muster bundle check "
               "b.tar.zst");
}

TEST(CommandWords, AParameterWithoutItsInstanceAndOneThatNoFitMoves) {
  EXPECT_THAT(
      said_beside_a_channel({"run", "lab", "--set", "n=1.7"}),
      testing::StartsWith("muster: error: there is no parameter \"n\"; did you mean \"channel/n\"? expected one of "));
  const std::string data = "m.csv", begin = "muster: error: --free channel/model: it is a choice of ";
  const ProgramFolder folder;
  folder.write("world.xml",
               R"(<world name="w" dt="1" until="2"><station name="a" at="0 0 1"/><station name="b" at="4 0 1"/>)"
               R"(<radio.multiwall name="channel"/></world>)");
  folder.write(data,
               "t[s],tx,rx,tx_x[m],tx_y[m],tx_z[m],rx_x[m],rx_y[m],rx_z[m],rssi[dBm]\n"
               "0,a,b,0,0,1,4,0,1,-50\n1,a,b,0,0,1,5,0,1,-52\n2,a,b,0,0,1,7,0,1,-56\n");
  const Outcome outcome = folder.muster({"fit", "world.xml", "--data", data, "--free", "channel/model"});
  EXPECT_EQ(outcome.exit, 2);
  EXPECT_THAT(outcome.err, testing::StartsWith(begin));
  EXPECT_THAT(outcome.err, HasSubstr(", which no fit moves; expected one of "));
  expect_error(folder.muster({"fit", "world.xml", "--data", data, "--free", "channel/n,channel/l0"}), 2,
               "--free takes one parameter each time; expected --free channel/n --free channel/l0");
  EXPECT_THAT(outcome.err, HasSubstr("channel/l0, channel/n ("));
  EXPECT_THAT(outcome.err, testing::Not(HasSubstr(", channel/model")));
}

TEST(CommandWords, APluginByItsFile) {
  for (const std::string name : {"radio_multiwall", "radio_multiwall.so"})
    EXPECT_EQ(said_beside_a_channel({"describe", name}), "muster: error: there is no element \"" + name +
                                                             "\", and a plugin has a dot in its name; expected "
                                                             "radio.multiwall\n");
}

TEST(CommandWords, ASeedBesideAStateIsNoted) {
  const ProgramFolder folder;
  folder.write("world.xml", R"(<world name="w" dt="1" until="4"><station name="a" at="0 0 1"/></world>)");
  ASSERT_EQ(folder.muster({"run", "world.xml", "--until", "2", "--save", "early"}).exit, 0);
  EXPECT_EQ(
      folder.muster({"run", "world.xml", "--restore", "early", "--seed", "5"}).err,
      "muster: note: --seed 5 counts from 2 s on: what early holds was drawn from the seed of its own run, and the "
      "fields of the channel are others from then on\n");
  EXPECT_EQ(folder.muster({"run", "world.xml", "--restore", "early"}).err, "");
}

TEST(CommandWords, AStateAfterTheEnd) {
  EXPECT_EQ(
      said_beside_a_channel({"run", "lab", "--restore", "early", "--until", "1"}),
      "muster: error: --restore: early stands at 2 s, after the end of the run at 1 s; expected --until above 2: it "
      "is a time of the world, not a duration\n");
}

}  // namespace
