// What may happen around a run: interrupts, output that cannot be written, a bare environment.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "program.hpp"

using namespace muster::test;
using testing::HasSubstr;
using testing::Not;

namespace {

const std::string toys = MUSTER_TOYS;

std::vector<std::string> long_run() {
  return {"run",  "world.xml", "--plugins", toys,       "--until",           "100000", "--digest-every",
          "1000", "--out",     "out",       "--record", "instance/good/cell"};
}

class Interrupt : public testing::TestWithParam<int> {};

INSTANTIATE_TEST_SUITE_P(Signals, Interrupt, testing::Values(SIGINT, SIGTERM, SIGHUP));

TEST_P(Interrupt, EndsTheRunWithWholeRecords) {
  const ProgramFolder folder;
  folder.write("world.xml", world_of("<test.good name=\"good\"/>"));
  Surroundings around;
  around.meanwhile = [](int process) { ::kill(process, GetParam()); };
  const auto outcome = folder.muster(long_run(), around);
  EXPECT_EQ(outcome.exit, 130) << outcome.err;
  EXPECT_LT(outcome.wall_seconds, 10);
  const std::string log = folder.read("out/instance_good_cell.csv");
  EXPECT_THAT(log, testing::EndsWith("\n"));
  EXPECT_GT(std::count(log.begin(), log.end(), '\n'), 1000);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out/instance_good_cell.csv.part"));
}

// What sees that a state holds all comes after the run, which is done and saved by then.
TEST(InterruptedProof, OfASavedStateLeavesTheRunDone) {
  const ProgramFolder folder;
  folder.write("world.xml", world_of("<test.good name=\"good\"/>"));
  Surroundings around;
  around.meanwhile = [](int process) { ::kill(process, SIGINT); };
  const auto outcome =
      folder.muster({"run", "world.xml", "--plugins", toys, "--until", "20000", "--save", "end.snap"}, around);
  EXPECT_EQ(outcome.exit, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("wrote end.snap"));
}

TEST(EndlessRun, IsToldWhenItWillEnd) {
  const ProgramFolder folder;
  std::string many;
  for (int i = 0; i < 40; ++i) many += "<test.good name=\"good" + std::to_string(i) + "\"/>";
  folder.write("world.xml", world_of(many));
  Surroundings around;
  around.meanwhile = [](int process) {
    ::usleep(3'500'000);
    ::kill(process, SIGINT);
  };
  const auto outcome =
      folder.muster({"run", "world.xml", "--plugins", toys, "--until", "9e10", "--digest-every", "100000"}, around);
  EXPECT_EQ(outcome.exit, 130);
  EXPECT_THAT(outcome.err,
              testing::ContainsRegex("muster: note: muster run [a-z]* ?takes another [0-9]+ (years|days|hours) at this "
                                     "pace; Ctrl-C ends it with all records whole\n"));
}

// Killed at once, a run of more than a second leaves what it had recorded.
TEST(Output, OfAKilledRunIsThereUpToTheLastSecond) {
  const ProgramFolder folder;
  folder.write("world.xml", world_of("<test.good name=\"good\"/>"));
  Surroundings around;
  around.meanwhile = [](int process) {
    ::usleep(2'500'000);
    ::kill(process, SIGKILL);
  };
  // A hundred rows a second: far less than a file's buffer.
  const std::vector<std::string> words = {
      "run",      "world.xml",          "--plugins",      toys, "--until",     "1000",    "--out", "out",
      "--record", "instance/good/cell", "--digest-every", "10", "--real-time", "--speed", "10"};
  EXPECT_EQ(folder.muster(words, around).exit, 128 + SIGKILL);
  const std::string log = folder.read("out/instance_good_cell.csv.part");
  EXPECT_GT(std::count(log.begin(), log.end(), '\n'), 20);
}

TEST(Output, ThatCannotBeWrittenIsAnErrorOfIts) {
  const ProgramFolder folder;
  folder.write("world.xml", world_of("<test.good name=\"good\"/>"));
  const std::vector<std::string> run = {"run", "world.xml", "--plugins", toys};
  Surroundings full;
  full.standard_output = "/dev/full";
  expect_error(folder.muster(run, full), 74, "standard output cannot be written");
  expect_error(folder.muster({"describe", "test.good", "--plugins", toys}, full), 74,
               "standard output cannot be written");
  // More than a buffer's worth, so that a write fails on the way.
  auto many = run;
  many.insert(many.end(), {"--until", "2000", "--digest-every", "1"});
  expect_error(folder.muster(many, full), 74, "standard output cannot be written");
}

// Two runs would write over each other's tables.
TEST(Output, AFolderThatAnotherRunWritesToIsRefused) {
  const ProgramFolder folder;
  folder.write("world.xml", world_of("<test.good name=\"good\"/>"));
  std::filesystem::create_directories(folder.path() / "out");
  const int other = ::open((folder.path() / "out").c_str(), O_RDONLY | O_DIRECTORY);
  ASSERT_EQ(::flock(other, LOCK_EX), 0);
  const std::vector<std::string> words = {"run", "world.xml", "--plugins", toys, "--out", "out"};
  expect_error(folder.muster(words), 74, "--out: out is written by another run at this time; expected another folder");
  ::close(other);
  EXPECT_EQ(folder.muster(words).exit, 0);
}

TEST(Output, AStandardErrorThatCannotBeWrittenEndsNoRun) {
  const ProgramFolder folder;
  folder.write("world.xml", world_of("<test.good name=\"good\"/>"));
  for (const std::string to : {"/dev/full", "&-"}) {
    Surroundings around;
    around.wrapper = {"sh", "-c", "exec \"$0\" \"$@\" 2>" + to};
    EXPECT_EQ(folder.muster({"run", "world.xml", "--plugins", toys}, around).exit, 0) << to;
    EXPECT_EQ(folder.muster({"run", "nowhere.xml"}, around).exit, 2) << to;
  }
}

TEST(Output, AFolderThatCannotBeMadeOrWrittenIsNamed) {
  const ProgramFolder folder;
  folder.write("world.xml", world_of("<test.good name=\"good\"/>"));
  folder.write("file", "");
  const std::vector<std::string> run = {"run",      "world.xml",          "--plugins", toys,
                                        "--record", "instance/good/cell", "--out"};
  auto words = run;
  words.push_back("file");
  expect_error(folder.muster(words), 2, "--out: file is a file; expected a folder");
  folder.write("data.csv", "tx,rx,distance[m],rssi[dBm]\na,b,1,-40\na,b,2,-47\na,b,3,-50\na,b,4,-53\n");
  folder.write("radio.xml", world_of("<radio.multiwall l0=\"40\" n=\"2\"/>"));
  expect_error(folder.muster({"fit", "radio.xml", "--data", "data.csv", "--out", "file/in"}), 74,
               "file/in: Not a directory");
  std::filesystem::create_directory(folder.path() / "locked");
  ::chmod((folder.path() / "locked").c_str(), 0555);
  Surroundings around;
  around.bound_by_permissions = true;
  words.back() = "locked";
  expect_error(folder.muster(words, around), 74, "locked/instance_good_cell.csv: cannot be written: Permission denied");
}

TEST(Environment, ABareOneIsEnough) {
  const ProgramFolder folder;
  folder.write("world.xml", world_of("<test.good name=\"good\"/>"));
  ::chmod(folder.path().c_str(), 0555);
  Surroundings around;
  around.environment = {"HOME", "TERM", "LANG", "PATH", "TMPDIR"};
  around.bound_by_permissions = true;  // the working directory cannot be written
  const auto outcome = folder.muster({"run", "world.xml", "--plugins", toys}, around);
  ::chmod(folder.path().c_str(), 0755);
  EXPECT_EQ(outcome.exit, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out, testing::StartsWith("w: 10 ticks, 1 s, digest "));
}

Outcome run_on_terminal(const ProgramFolder& folder, const std::vector<std::string>& environment) {
  folder.write("world.xml", world_of("<test.good name=\"good\"/>"));
  Surroundings around;
  around.terminal = true;
  around.environment = environment;
  auto outcome = folder.muster({"run", "world.xml", "--plugins", toys, "--until", "200"}, around);
  EXPECT_EQ(outcome.exit, 0) << outcome.err;
  return outcome;
}

TEST(Terminal, ShowsProgressWithoutColoursAndADumbOneNothing) {
  const ProgramFolder folder;
  EXPECT_THAT(run_on_terminal(folder, {"TERM=xterm", "NO_COLOR"}).err, HasSubstr("muster run w  50% [===="));
  EXPECT_THAT(run_on_terminal(folder, {"TERM=xterm", "NO_COLOR=1"}).err,
              Not(testing::ContainsRegex("\x1b\\[[0-9;]*m")));
  EXPECT_EQ(run_on_terminal(folder, {"TERM=dumb"}).err, "");
}

TEST(Terminal, NothingIsShownWhereThereIsNone) {
  const ProgramFolder folder;
  folder.write("world.xml", world_of("<test.good name=\"good\"/>"));
  EXPECT_EQ(folder.muster({"run", "world.xml", "--plugins", toys}).err, "");
}

}  // namespace
