// A plugin whose step() crashes is named before the signal ends the program; in a process of its own, it ends that.
#include <gmock/gmock.h>

#include "tests/cli/errors/program.hpp"
#include "tests/sanitized.hpp"

using namespace muster::test;

namespace {

Outcome crashed(const std::string& attributes, const std::string& workers) {
  const ProgramFolder folder;
  folder.write("world.xml", world_of("<test.crash name=\"mine\" " + attributes + "/>"));
  return folder.muster({"run", "world.xml", "--plugins", MUSTER_TOYS, "--workers", workers});
}

TEST(Crash, OfAStepNamesThePluginAndTheTick) {
  if (sanitized) GTEST_SKIP() << "the sanitizer reports it";
  const std::string line =
      "muster: error: world.xml:1:36: mine (test.crash): step crashed at tick 3: a segmentation fault (SIGSEGV) in the "
      "plugin; a debugger shows where, and the line of a plugin built with -D CMAKE_BUILD_TYPE=Debug: gdb -ex run "
      "--args "
      "muster ...\n";
  const auto alone = crashed("", "1");
  EXPECT_EQ(alone.exit, 128 + 11);
  EXPECT_EQ(alone.err, line);
  const auto parallel = crashed("parallel=\"true\"", "2");
  EXPECT_EQ(parallel.exit, 128 + 11);
  EXPECT_THAT(parallel.err, testing::StartsWith(line));  // two threads may crash at once
  // Of the very stack that a handler runs on by default.
  const auto overflow = crashed("how=\"overflow\"", "2");
  EXPECT_EQ(overflow.exit, 128 + 11);
  EXPECT_EQ(overflow.err, line);
}

TEST(Crash, ExitOfAPluginIsItsFault) {
  for (const char* how : {"exit", "quick_exit", "_exit", "_Exit"})
    EXPECT_EQ(
        crashed(std::string("how=\"") + how + '"', "1").err,
        "muster: error: world.xml:1:36: mine (test.crash): step failed at tick 3: the plugin ends the whole process "
        "by exit(); expected it to throw, or to report and return\n");
  for (const char* how : {"exit", "_exit"}) EXPECT_EQ(crashed(std::string("how=\"") + how + '"', "1").exit, 3);
  const auto outcome = crashed("how=\"child\"", "1");
  EXPECT_EQ(outcome.exit, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
}

TEST(Crash, OfAThreadOfAPluginsOwnIsTold) {
  if (sanitized) GTEST_SKIP() << "the sanitizer reports it";
  const auto outcome = crashed("how=\"thread\"", "1");
  EXPECT_EQ(outcome.exit, 128 + 11);
  EXPECT_THAT(outcome.err, testing::StartsWith("muster: error: crashed outside of every callback: a segmentation fault "
                                               "(SIGSEGV), in a thread that a plugin has started"));
  EXPECT_THAT(outcome.err, testing::HasSubstr("muster run --isolate all names"));
}

TEST(Crash, WordsOfAPluginAreCutAndNoTerminalObeysThem) {
  const auto outcome = crashed("how=\"tells\"", "1");
  EXPECT_EQ(outcome.exit, 3);
  EXPECT_THAT(outcome.err, testing::HasSubstr("eeee... (998000 bytes more)"));
  EXPECT_LT(outcome.err.size(), 3000u);
  EXPECT_EQ(outcome.out.find('\x1b'), outcome.out.npos);
}

TEST(Crash, InAProcessOfItsOwnEndsTheRunOrCostsThatPluginOnly) {
  if (sanitized) GTEST_SKIP() << "the sanitizer reports it";
  const ProgramFolder folder;
  folder.write("world.xml", world_of("<test.crash name=\"mine\"/>"));
  const auto run = [&](const std::string& how) {
    return folder.muster({"run", "world.xml", "--plugins", MUSTER_TOYS, "--isolate", how});
  };
  expect_error(run("mine"), 3,
               "world.xml:1:36: mine (test.crash): step failed at tick 3 (t = 0.3 s): its own process ended with a "
               "segmentation fault (SIGSEGV)");
  expect_error(run("mine=restart"), 3,
               "world.xml:1:36: mine (test.crash): step failed at tick 3 (t = 0.3 s): its own process ended with a "
               "segmentation fault (SIGSEGV), and so did the one that took its place in this step");
  folder.write("world.xml", world_of("<test.crash name=\"mine\" how=\"exit\"/>"));
  expect_error(
      run("mine"), 3,
      "world.xml:1:36: mine (test.crash): step failed at tick 3 (t = 0.3 s): its own process ended with exit(0)");
  folder.write("world.xml", world_of("<test.crash name=\"mine\"/>"));
  const auto without = run("mine=without");
  EXPECT_EQ(without.exit, 0);
  EXPECT_THAT(without.out, testing::HasSubstr("t = 0.3 s  mine: warning: its own process ended with a segmentation "
                                              "fault (SIGSEGV); the run goes on without it"));
}

// The others of a team have the same ways as where it does not crash.
TEST(Crash, InMixedTeamCostsThatPluginOnly) {
  if (sanitized) GTEST_SKIP() << "the sanitizer reports it";
  const ProgramFolder folder;
  std::filesystem::copy(MUSTER_SOURCE_DIR "/worlds/mixed_team", folder.path(),
                        std::filesystem::copy_options::recursive);
  const auto poses = [&](const std::string& out, const std::vector<std::string>& more) {
    std::vector<std::string> words{"run", "world.xml", "--until", "2", "--out", out, "--plugins", MUSTER_TOYS};
    words.insert(words.end(), more.begin(), more.end());
    EXPECT_EQ(folder.muster(words).exit, 0);
    return folder.read(out + "/robot_pose.csv");
  };
  const std::string alone = poses("alone", {});
  const std::string world = folder.read("world.xml");
  folder.write("world.xml", world.substr(0, world.rfind("</world>")) + "<test.crash name=\"mine\"/></world>");
  EXPECT_EQ(poses("beside", {"--isolate", "mine=without"}), alone);
  EXPECT_GT(alone.size(), 1000u);
}

TEST(Crash, IsolateSaysWhatItTakes) {
  const ProgramFolder folder;
  folder.write("world.xml", world_of("<test.crash name=\"mine\"/>"));
  const auto refused = [&](const std::vector<std::string>& words, const std::string& message) {
    std::vector<std::string> all{"run", "world.xml", "--plugins", MUSTER_TOYS};
    all.insert(all.end(), words.begin(), words.end());
    expect_error(folder.muster(all), 2, message);
  };
  refused({"--isolate", "mine=again"},
          "--isolate: mine: there is no \"again\"; expected one of stop, restart, without");
  refused({"--isolate", "=stop"},
          "--isolate: \"=stop\" names no instance; expected such as physics, physics=restart or all");
  refused({"--isolate", "mine", "--isolate", "mine"}, "--isolate: mine is named twice");
  refused({"--isolate", "yours"}, "no instance is called \"yours\"; expected mine");
  refused({"--isolate", "mine", "--isolate-limit", "0"},
          "--isolate-limit: 0 s is out of bounds; expected 0.01 to 86400 s");
  refused({"--isolate-limit", "3"},
          "muster run: --isolate-limit has no effect without --isolate; expected --isolate beside it, or no "
          "--isolate-limit; see muster run --help");
}

}  // namespace
