// `run` with a log, and `muster log`, as their user has them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/errors/program.hpp"

namespace muster::test {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

const std::string world = MUSTER_LOG_WORLD;

std::string printed(const ProgramFolder& folder, const std::vector<std::string>& words, int exit = 0) {
  const Outcome outcome = folder.muster(words);
  EXPECT_EQ(outcome.exit, exit) << outcome.err;
  return outcome.out;
}

TEST(LogVerb, RunsWriteWhatIsRequested) {
  const ProgramFolder folder;
  const std::string out = printed(folder, {"run", world, "--until", "2", "--mcap", "made/run.mcap", "--wide", "run.csv",
                                           "--out", "out", "--plot", "robot/*/twist/vx"});
  for (const char* file : {"made/run.mcap", "run.csv", "out/plot_robot_twist_vx.svg", "out/robot_twist.csv"}) {
    EXPECT_THAT(out, HasSubstr(std::string("wrote ") + file)) << file;
    EXPECT_TRUE(std::filesystem::exists(folder / file)) << file;
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "made/run.mcap.part"));
  const std::string figure = folder.read("out/plot_robot_twist_vx.svg");
  for (const char* words : {"east", "north", "rover-2", "m/s"}) EXPECT_THAT(figure, HasSubstr(words));
  printed(folder, {"log", "csv", "made/run.mcap", "-o", "again.csv"});
  EXPECT_EQ(folder.read("run.csv"), folder.read("again.csv"));
}

TEST(LogVerb, ALogChangesNothing) {
  const ProgramFolder folder;
  EXPECT_EQ(printed(folder, {"run", world, "--until", "2", "--digest-every", "20"}).substr(0, 90),
            printed(folder, {"run", world, "--until", "2", "--digest-every", "20", "--mcap", "a.mcap"}).substr(0, 90));
  printed(folder, {"run", world, "--until", "2", "--workers", "3", "--mcap", "b.mcap"});
  EXPECT_EQ(folder.read("a.mcap"), folder.read("b.mcap"));
}

TEST(LogVerb, ASwapGoesOnInTheSameChannels) {
  const ProgramFolder folder;
  printed(folder, {"swap", world, "--until", "2", "--mcap", "a.mcap", "--at", "1", "--instance", "c1", "--plugin",
                   "control.steady", "robot=east", "v=0.1"});
  const std::string info = printed(folder, {"log", "info", "a.mcap"});
  EXPECT_THAT(info, ContainsRegex("/robot/east/pose +muster/msg/RobotPose +101 "));
  EXPECT_THAT(info, ContainsRegex("/events +rcl_interfaces/msg/Log +1 "));
}

TEST(LogVerb, InfoOfADamagedFileEndsWithOne) {
  const ProgramFolder folder;
  printed(folder, {"run", world, "--until", "5", "--mcap", "a.mcap"});
  folder.write("torn.mcap", folder.read("a.mcap").substr(0, 20'000));
  EXPECT_THAT(printed(folder, {"log", "info", "torn.mcap"}, 1), ContainsRegex("byte [0-9]+: a record of [0-9]+ bytes"));
  EXPECT_THAT(printed(folder, {"log", "recover", "torn.mcap"}), HasSubstr("wrote torn_recovered.mcap: "));
  EXPECT_THAT(printed(folder, {"log", "info", "torn_recovered.mcap", "--json"}), HasSubstr("\"whole\": true"));
}

// A table was written into run.mcap, and a log of a run that was killed over that of an earlier one.
TEST(LogVerb, WhatIsMadeOfAPartTakesNoOthersPlace) {
  const ProgramFolder folder;
  printed(folder, {"run", world, "--until", "1", "--mcap", "run.mcap"});
  const std::string whole = folder.read("run.mcap");
  folder.write("run.mcap.part", whole);
  EXPECT_THAT(printed(folder, {"log", "csv", "run.mcap.part"}), HasSubstr("wrote run.csv: "));
  expect_error(folder.muster({"log", "recover", "run.mcap.part"}), 2,
               "run.mcap is there already, which may be an earlier run's log; expected another file to write: -o FILE");
  EXPECT_EQ(folder.read("run.mcap"), whole);
  EXPECT_THAT(printed(folder, {"log", "recover", "run.mcap.part", "-o", "other.mcap"}),
              HasSubstr("wrote other.mcap: "));
  std::filesystem::remove(folder / "run.mcap");
  EXPECT_THAT(printed(folder, {"log", "recover", "run.mcap.part"}), HasSubstr("wrote run.mcap: "));
}

TEST(LogVerb, RefusesWhatItCannotDo) {
  const ProgramFolder folder;
  const auto refused = [&](const std::vector<std::string>& words, const std::string& message, int exit = 2) {
    expect_error(folder.muster(words), exit, message);
  };
  folder.write("a.txt", "nothing of the kind");
  refused({"log", "info", "a.txt"},
          "a.txt: byte 0: is no MCAP file; one begins with the bytes 89 4d 43 41 50 30 0d 0a");
  refused({"log", "info", "b.mcap"}, "b.mcap: cannot be read: No such file or directory", 74);
  refused({"log", "cut", "a.txt", "--from", "1"}, "cut needs --out, the file to write");
  refused({"log", "cut", "a.txt", "-o", "b", "--from", "2", "--to", "2"},
          "--from 2 is not before --to 2, which is not included");
  refused({"log", "cut", "a.txt", "-o", "b", "--from", "3", "--to", "1"},
          "--from 3 is after --to 1; expected --from 1 --to 3");
  refused({"log", "cut", "a.txt", "-o", "b", "--from", "1min"},
          "--from: \"1min\" is not a number; \"min\" follows the number: units are fixed and not written; expected "
          "seconds: --from 60");
  refused({"log", "csv", "a.txt", "--from", "1", "--to", "2"},
          "--from and --to are of cut, not of csv; expected first muster log cut a.txt --from 1 --to 2 -o part.mcap, "
          "then muster log csv part.mcap");
  refused({"log", "info", "a.txt", "-o", "b"},
          "--out is of recover, cut and csv; info writes no file; expected no --out, or info > b");
  std::filesystem::create_directories(folder.path() / "bag");
  refused({"log", "info", "bag"},
          "bag: is a folder; expected an MCAP file, and it has none (muster run WORLD --mcap FILE writes one)");
  folder.write("bag/bag_0.db3", "x");
  refused(
      {"log", "info", "bag"},
      "bag: is a folder; expected an MCAP file, and it has none: its .db3 is a bag in SQLite, which ros2 bag convert "
      "writes anew with storage_id: mcap");
  folder.write("bag/bag_0.mcap", "x");
  refused({"log", "info", "bag"}, "bag: is a folder; expected the MCAP file in it, bag/bag_0.mcap");
  folder.write("bag/bag_1.mcap", "x");
  refused({"log", "info", "bag"}, "bag: is a folder; expected one of its MCAP files, such as bag/bag_0.mcap");
  refused({"log", "recover", "a.txt", "--column", "x"}, "--column is of csv, not of recover");
  refused({"run", world, "--plot", "robot/*/pose/x"}, "--plot needs --out, the folder to draw into");
  refused({"run", world, "--plot", "pose", "--out", "o"},
          "--plot \"pose\": expected a table and its column, such as 'robot/*/pose/x'");
  refused(
      {"run", world, "--plot", "robot/*/pose/quw", "--out", "o"},
      "--plot: the table \"robot/*/pose\" has no column \"quw\" of numbers; expected one of x, y, z, qw, qx, qy, qz; "
      "did you mean \"qw\"?");
  refused({"run", world, "--plot", "robot/*/pose/yaw", "--out", "o"},
          "--plot: the table \"robot/*/pose\" has no column \"yaw\" of numbers; expected one of x, y, z, qw, qx, qy, "
          "qz; the turn here is the quaternion qw, qx, qy, qz");
  refused({"run", world, "--record", "robot/*/twist"},
          "--record needs --out, the folder to write to, or --mcap, a log");
  refused({"run", world, "--mcap", "a.txt/b.mcap"}, "a.txt: cannot be made: Not a directory", 74);
}

}  // namespace
}  // namespace muster::test
