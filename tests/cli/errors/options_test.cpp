// Options that would do nothing, or something else than is meant, are refused with what is expected.
#include <gmock/gmock.h>

#include <algorithm>

#include "program.hpp"

using namespace muster::test;
using testing::HasSubstr;

namespace {

class Words : public ::testing::Test {
 protected:
  Words() { folder.write("world.xml", world_of("<robot name=\"rover\" at=\"0 0 0\"/><test.good name=\"good\"/>")); }

  Outcome run(std::vector<std::string> words) const {
    words.insert(words.begin(), {"run", "world.xml", "--plugins", MUSTER_TOYS});
    return folder.muster(words);
  }
  void refused(const std::vector<std::string>& words, const std::string& message) const {
    expect_error(run(words), 2, message);
  }

  ProgramFolder folder;
};

const std::string see = "; see muster run --help";

TEST_F(Words, BoundsAreToldAsThoseOfAttributes) {
  refused({"--workers", "0"}, "muster run: --workers: 0 is out of bounds; expected an integer from 1 to 256" + see);
  refused({"--workers", "two"},
          "muster run: --workers: \"two\" is not an integer; expected an integer from 1 to 256" + see);
  refused({"--digest-every", "-1"},
          "muster run: --digest-every: -1 is out of bounds; expected an integer from 1" + see);
  refused({"--set"}, "muster run: --set has no value; expected one behind it" + see);
  expect_error(folder.muster({"map", "world.xml", "--out", "m", "--area", "0", "0", "5"}), 2,
               "muster map: --area: expected 4 words, not 3; see muster map --help");
}

TEST_F(Words, NumbersOfOneOptionArePartedByBlanks) {
  const std::vector<std::string> roadmap = {"roadmap", "world.xml", "--out", "r.csv", "--radius", "0.2", "--to", "3,2"};
  expect_error(folder.muster(roadmap), 2,
               "muster roadmap: --to: expected 2 words, not 1; did you mean --to 3 2?; see muster roadmap --help");
  expect_error(folder.muster({"map", "world.xml", "--out", "m", "--area", "0;0;12;8"}), 2,
               "muster map: --area: expected 4 words, not 1; did you mean --area 0 0 12 8?; see muster map --help");
}

TEST_F(Words, WhatAnotherOptionMakesVoidIsRefused) {
  const auto roadmap = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"roadmap", "world.xml", "--out", "r.csv"});
    return folder.muster(words);
  };
  expect_error(roadmap({"--step", "0.1"}), 2,
               "muster roadmap: --step has no effect without --method grid; expected --method grid beside it, or no "
               "--step; see muster roadmap --help");
  expect_error(roadmap({"--robot", "rover", "--height", "1"}), 2,
               "muster roadmap: --height has no effect without --radius; expected --radius beside it, or no --height; "
               "see muster roadmap --help");
  for (const std::vector<std::string>& option :
       {std::vector<std::string>{"--until", "1"}, {"--digest-every", "2"}, {"--watch"}, {"--real-time"}}) {
    std::vector<std::string> words = option;
    words.push_back("--expected");
    refused(words, "muster run: " + option[0] +
                       " has no effect beside --expected, which runs no tick; expected one of the "
                       "two" +
                       see);
  }
  refused({"--view", "--origin", "app.foxglove.dev"},
          "--origin: \"app.foxglove.dev\" is no origin of a page; expected https://app.foxglove.dev");
  refused({"--view", "--origin", "https://app.foxglove.dev/view"},
          "--origin: \"https://app.foxglove.dev/view\" is no origin of a page; expected https://app.foxglove.dev");
  refused({"--out", ""}, "muster run: --out has an empty value; expected one behind it" + see);
  refused({"--set", "good/x:=2"}, "--set \"good/x:=2\" has := as ROS has it; expected PATH=VALUE: --set good/x=2");
  expect_error(
      folder.muster({"swap", "world.xml", "--plugins", MUSTER_TOYS, "--at", "0.1", "--instance", "good", "--plugin",
                     "test.good", "--expected"}),
      2,
      "muster swap: --expected runs no tick, so that nothing is exchanged; expected muster run WORLD --expected, "
      "or no --expected");
}

TEST_F(Words, SeveralSeedsAreThoseOfASweep) {
  const std::string begin = " is no seed; expected an integer from 0", sweep =
                                                                           ", and one: of several seeds, muster sweep, "
                                                                           "with seeds=\"";
  refused({"--seed", "1..20"}, "--seed: \"1..20\"" + begin + sweep + "1..20\" in its file");
  refused({"--seed", "1-20"}, "--seed: \"1-20\"" + begin + sweep + "1..20\" in its file");
  refused({"--seed", "1,2,3"}, "--seed: \"1,2,3\"" + begin + sweep + "1 2 3\" in its file");
  refused({"--seed", "1.5"}, "--seed: \"1.5\"" + begin);
  refused({"--seed", "-3"}, "--seed: \"-3\"" + begin);
  refused({"--seed", "one"}, "--seed: \"one\"" + begin);
}

TEST_F(Words, OptionsOfAViewNeedIt) {
  for (const std::string option : {"--port", "--token", "--address"})
    refused({option, "80"}, "muster run: " + option +
                                " has no effect without --view; expected --view beside it, or no " + option + see);
  refused(
      {"--port", "80", "--paused"},
      "muster run: --port and --paused have no effect without --view; expected --view beside them, or none of them" +
          see);
}

TEST_F(Words, OneWordTooManyMayBeAnOption) {
  refused({"until=5"}, "muster run: \"until=5\" is one word too many; did you mean --until 5?" + see);
  refused({"--set", "good/size", "2"}, "muster run: \"2\" is one word too many; did you mean --set good/size=2?" + see);
}

TEST_F(Words, ParametersAreSetOnceAndAreThoseOfARun) {
  refused({"--set", "good/size=1", "--set", "good/size=2"},
          "--set: good/size is given more than once; expected one value");
  refused({"--set", "world/until=5"}, "--set: \"world/until\" is no parameter; expected --until");
  refused(
      {"--set", "rover/at=1 0 0"},
      "--set: \"rover/at\" is no parameter: what a robot is and where it starts stand in the world's file; expected "
      "it there, at world.xml:1:36");
}

TEST_F(Words, AWideTableNeedsRecords) {
  refused({"--wide", "wide.csv"},
          "--wide: the world records no table; expected <record table=\"robot/*/pose\"/>, or --record");
}

TEST_F(Words, ARestoredRunThatIsOverIsNoted) {
  ASSERT_EQ(run({"--save", "end.snap"}).exit, 0);
  const Outcome over = run({"--restore", "end.snap"});
  EXPECT_EQ(over.exit, 0);
  EXPECT_EQ(over.err,
            "muster: note: --restore: end.snap stands at 1 s, the end of the run, so that no tick is run; expected a "
            "later end (--until)\n");
}

// The swap never took place, without a word.
TEST_F(Words, ASwapBeforeTheRestoredTimeIsRefused) {
  ASSERT_EQ(run({"--until", "0.5", "--save", "half.snap"}).exit, 0);
  const auto swap = [&](const std::string& at, const std::string& plugin, const std::string& option,
                        const std::string& state) {
    return folder.muster({"swap", "world.xml", "--plugins", MUSTER_TOYS, "--at", at, "--instance", "good", "--plugin",
                          plugin, option, state});
  };
  expect_error(swap("0.2", "test.keeps_caches", "--restore", "half.snap"), 2,
               "--at: 0.2 s is before 0.5 s, where --restore: half.snap stands, so that nothing would be exchanged; "
               "expected a time from 0.5 s on");
  EXPECT_EQ(swap("0.5", "test.keeps_caches", "--restore", "half.snap").exit, 0);
  ASSERT_EQ(swap("0.2", "test.keeps_caches", "--save", "swapped.snap").exit, 0);
  const Outcome later =
      folder.muster({"swap", "world.xml", "--plugins", MUSTER_TOYS, "--at", "0.2", "--instance", "good", "--plugin",
                     "test.keeps_caches", "--restore", "swapped.snap", "--until", "2"});
  EXPECT_EQ(later.exit, 0) << "it was exchanged before: " << later.err;
}

// The start was written, and what is expected once more for the same moment.
TEST_F(Words, WhatIsExpectedIsWrittenOnce) {
  folder.write("world.xml", world_of("<station name=\"a\" at=\"0 0 1\"/><test.good/>"));
  ASSERT_EQ(run({"--expected", "--out", "out", "--record", "endpoint/*/pose"}).exit, 0);
  const std::string table = folder.read("out/endpoint_pose.csv");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 2) << table;
}

TEST_F(Words, AFileIsNoPlugin) {
  expect_error(folder.muster({"describe", "world.xml"}), 2,
               "muster describe: world.xml is a file; expected a plugin or an element (muster check reads a world)");
}

TEST_F(Words, AWorldAndItsDataAreNotExchanged) {
  folder.write("data.csv", "tx,rx,rssi[dBm]\na,b,-50\n");
  expect_error(
      folder.muster({"fit", "data.csv", "--data", "world.xml"}), 2,
      "muster fit: --data world.xml begins with '<' as a world does, and data.csv does not; expected muster fit "
      "WORLD --data TABLE");
}

TEST_F(Words, AFitNeedsAModelOfTheChannel) {
  folder.write("data.csv", "tx,rx,distance[m],rssi[dBm]\na,b,1,-50\na,b,2,-56\n");
  if (!std::filesystem::exists(MUSTER_PLUGINS_DIR "/radio_fading.so")) GTEST_SKIP() << "without radio.fading";
  folder.write("flat.xml", world_of("<radio.fading shadowing=\"0\"/>"));
  expect_error(folder.muster({"fit", "flat.xml", "--data", "data.csv"}), 2,
               "no parameter is free: no part of the world's radio channel has one; expected one that does, such as "
               "<radio.multiwall/>, or --free PATH");
}

TEST_F(Words, ASwapIsToldByItsVerb) {
  EXPECT_THAT(folder
                  .muster({"swap", "world.xml", "--at", "0.5", "--instance", "good", "--plugin", "test.good", "siez=1",
                           "--plugins", MUSTER_TOYS})
                  .err,
              testing::StartsWith("muster: error: muster swap: <test.good> has no attribute \"siez\""));
}

TEST_F(Words, TwoTermsThatAreOneAreWarnedOf) {
  const std::string terms =
      "<station name=\"a\" at=\"0 0 1\"/>\n<radio.multiwall/>\n<radio.multiwall name=\"second\"/>";
  folder.write("twice.xml", world_of(terms));
  const std::string warning =
      "warning: twice.xml:3:1: second (radio.multiwall) and twice.xml:2:1: radio.multiwall (radio.multiwall) both add "
      "the loss by distance and walls to link/*/level, which then counts twice; expected one of the two";
  EXPECT_THAT(folder.muster({"check", "twice.xml"}).out, testing::StartsWith(warning));
  EXPECT_THAT(folder.muster({"run", "twice.xml"}).err, HasSubstr(warning));
  folder.write("once.xml", world_of("<station name=\"a\" at=\"0 0 1\"/><radio.multiwall/>"));
  EXPECT_THAT(folder.muster({"check", "once.xml"}).out, testing::Not(HasSubstr("counts twice")));
}

}  // namespace
