// Words of the command line that are off by a little.
#include <gmock/gmock.h>

#include "tests/cli/errors/program.hpp"

using namespace muster::test;

namespace {

TEST(FirstHour, AMisspeltOptionIsToldWithTheNearest) {
  const ProgramFolder folder;
  folder.write("world.xml", world_of(""));
  const auto outcome = folder.muster({"run", "world.xml", "--untl", "3"});
  EXPECT_EQ(outcome.exit, 2);
  EXPECT_THAT(outcome.err, testing::StartsWith("muster: error: muster run: there is no option \"--untl\"; did you mean "
                                               "\"--until\"? expected one of --help, "));
  EXPECT_THAT(outcome.err, testing::EndsWith("; see muster run --help\n"));
  expect_error(folder.muster({"check", "world.xml", "other.xml"}), 2,
               "muster check: \"other.xml\" is one word too many; see muster check --help");
}

TEST(FirstHour, AnOptionGivenTwice) {
  const ProgramFolder folder;
  folder.write("world.xml", world_of(""));
  expect_error(folder.muster({"swap", "world.xml", "--at", "1", "--at", "2", "--instance", "a", "--plugin", "b.c"}), 2,
               "muster swap: --at is given more than once; expected one value; see muster swap --help");
}

TEST(FirstHour, AFamilyOfPluginsIsNoPlugin) {
  const ProgramFolder folder;
  const auto outcome = folder.muster({"describe", "radio"});
  EXPECT_EQ(outcome.exit, 2);
  EXPECT_THAT(outcome.err,
              testing::StartsWith("muster: error: there is no element \"radio\", and a plugin has a dot in its name; "
                                  "expected one of radio."));
  EXPECT_THAT(outcome.err, testing::HasSubstr(", radio.multiwall, "));
}

TEST(FirstHour, AWorldWithoutItsVerb) {
  const ProgramFolder folder;
  folder.write("world.xml", world_of(""));
  expect_error(
      folder.muster({"world.xml"}), 2,
      "there is no verb \"world.xml\", which is a file; did you mean muster run world.xml? muster --help lists "
      "the verbs");
  expect_error(folder.muster({"run", "--world", "world.xml"}), 2,
               "muster run: there is no option \"--world\"; the world stands without an option: muster run world.xml; "
               "see muster run --help");
}

TEST(FirstHour, ATableAndAModelAreNoPlugins) {
  const ProgramFolder folder;
  expect_error(
      folder.muster({"describe", "robot/rover/pose"}), 2,
      "there is no plugin or element \"robot/rover/pose\"; is this a table? muster graph WORLD lists those of a "
      "world, and who writes them");
  EXPECT_THAT(
      folder.muster({"describe", "scarab"}).err,
      testing::StartsWith("muster: error: there is no element \"scarab\", but a model: <robot model=\"scarab\"/>, "
                          "described by "));
}

TEST(FirstHour, APlotOfNoTick) {
  const ProgramFolder folder;
  folder.write("world.xml", world_of("<robot name=\"a\" at=\"0 0 0\"/><physics.planar/>"));
  expect_error(folder.muster({"run", "world.xml", "--expected", "--out", "out", "--plot", "robot/a/pose/x"}), 2,
               "--plot shows a run, and --expected runs no tick; expected one of them");
}

}  // namespace
