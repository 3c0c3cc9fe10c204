// A plugin whose step() crashes is named before the signal ends the program.
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
}

}  // namespace
