// A command never writes over what it reads, nor twice into one file; what stands there stays as it was.
#include "program.hpp"

using namespace muster::test;

namespace {

const std::string data = "t[s],tx,rx,tx_x[m],tx_y[m],rx_x[m],rx_y[m],rssi[dBm]\n0,a,b,0,0,5,0,-50\n1,a,b,0,0,6,0,-52\n";

class WrittenFiles : public ::testing::Test {
 protected:
  WrittenFiles() {
    folder.write("world.xml", world_of(R"(<station name="a" at="0 0 1"/><test.good/>)"));
    folder.write("data.csv", data);
  }

  void refused(std::vector<std::string> words, const std::string& message) const {
    SCOPED_TRACE(words[0]);
    const std::string world = folder.read("world.xml");
    if (words[0] == "run") words.insert(words.end(), {"--plugins", MUSTER_TOYS});
    expect_error(folder.muster(words), 2, message);
    EXPECT_EQ(folder.read("world.xml"), world);
    EXPECT_EQ(folder.read("data.csv"), data);
  }

  ProgramFolder folder;
};

TEST_F(WrittenFiles, AreNotThoseThatTheCommandReads) {
  const std::string another = "; expected another file to write";
  for (const std::string option : {"--mcap", "--wide", "--save"})
    refused({"run", "world.xml", option, "./world.xml"},
            option + ": ./world.xml is read by this command (the world)" + another);
  refused({"features", "world.xml", "--data", "data.csv", "--out", "data.csv"},
          "--out: data.csv is read by this command (--data)" + another);
  folder.write("data.map", "rssi[dBm] = rssi\n");
  refused({"import", "data.csv", "--map", "data.map", "--out", "data.csv"},
          "--out: data.csv is read by this command (file)" + another);
  refused({"import", "data.csv", "--map", "data.map", "--out", "data.map"},
          "--out: data.map is read by this command (--map)" + another);
  for (const std::string action : {"cut", "csv", "recover"})
    refused({"log", action, "data.csv", "--out", "data.csv"},
            "--out: data.csv is read by this command (the log)" + another);
}

TEST_F(WrittenFiles, AreNotThoseThatTheWorldNames) {
  std::filesystem::create_hard_link(folder.path() / "data.csv", folder.path() / "same.csv");
  folder.write("world.xml", world_of(R"(<station name="a" at="0 0 1"/><test.good file="data.csv"/>)"));
  refused({"run", "world.xml", "--wide", "same.csv"},
          "--wide: same.csv is read by this command (file of world.xml:1:83); expected another file to write");
}

TEST_F(WrittenFiles, AreNotTheRecordOfARunThatAReportReads) {
  std::filesystem::create_directory(folder.path() / "out");
  folder.write("out/run.json", "{}");
  refused({"report", "out", "--out", "out/run.json"},
          "--out: out/run.json is read by this command (the record); expected another file to write");
}

TEST_F(WrittenFiles, AreOneFileForOneOption) {
  refused({"run", "world.xml", "--mcap", "new/x", "--save", "new/../new/x"},
          "--save: new/../new/x is written by this command already (--mcap); expected another file to write");
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "new"));
}

TEST_F(WrittenFiles, AreNoFoldersAndFoldersAreNoFiles) {
  std::filesystem::create_directory(folder.path() / "out");
  refused(
      {"run", "world.xml", "--mcap", "/dev/null"},
      "--mcap: /dev/null is a device or a pipe, which a file would take the place of; expected another file to write");
  refused({"run", "world.xml", "--save", "out"}, "--save: out is a folder; expected another file to write");
  refused({"run", "world.xml", "--out", "data.csv"}, "--out: data.csv is a file; expected a folder");
  refused({"fit", "world.xml", "--data", "data.csv", "--out", "data.csv"},
          "--out: data.csv is a file; expected a folder");
  refused({"diagnose", "world.xml", "--data", "data.csv", "--out", "data.csv"},
          "--out: data.csv is a file; expected a folder");
  refused({"map", "world.xml", "--out", "data.csv"}, "--out: data.csv is a file; expected a folder");
}

TEST_F(WrittenFiles, MayReplaceAnOlderOne) {
  folder.write("old.snap", "old");
  const auto again = folder.muster({"run", "world.xml", "--save", "old.snap", "--plugins", MUSTER_TOYS});
  EXPECT_EQ(again.exit, 0) << again.err;
  EXPECT_NE(folder.read("old.snap"), "old");
  const auto goes_on = folder.muster(
      {"run", "world.xml", "--until", "2", "--restore", "old.snap", "--save", "old.snap", "--plugins", MUSTER_TOYS});
  EXPECT_EQ(goes_on.exit, 0) << goes_on.err;
}

TEST_F(WrittenFiles, SecondReadingsAreNotTheFirst) {
  refused({"diagnose", "world.xml", "--data", "data.csv", "--second", "./data.csv", "--out", "o"},
          "muster diagnose: --second: ./data.csv is --data itself; expected readings that were not used; see muster "
          "diagnose --help");
}

TEST_F(WrittenFiles, AMapNeedsAChannel) {
  folder.write("world.xml", world_of(R"(<station name="a" at="0 0 1"/><station name="b" at="5 0 1"/>)"));
  refused({"map", "world.xml", "--out", "map"},
          "world.xml: the world has no radio channel; expected one, such as <radio.multiwall/>");
}

TEST_F(WrittenFiles, AreNoTableOfTheUsers) {
  std::filesystem::create_directory(folder.path() / "out");
  const std::vector<std::string> run{"run",      "world.xml",       "--out",     "out",
                                     "--record", "endpoint/*/pose", "--plugins", MUSTER_TOYS};
  folder.write("out/endpoint_pose.csv", "mine\n");
  expect_error(
      folder.muster(run), 2,
      "out/endpoint_pose.csv: is there already and was not recorded by a run of these tables; expected another "
      "folder, or that file taken away");
  EXPECT_EQ(folder.read("out/endpoint_pose.csv"), "mine\n");
  std::filesystem::remove(folder.path() / "out/endpoint_pose.csv");
  EXPECT_EQ(folder.muster(run).exit, 0);
  EXPECT_EQ(folder.muster(run).exit, 0);  // over its own
}

// Its second part would take the place of the first.
TEST_F(WrittenFiles, AreNotTheRecordOfARunThatGoesOn) {
  const auto run = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"run", "world.xml", "--record", "endpoint/*/pose", "--plugins", MUSTER_TOYS});
    return folder.muster(words);
  };
  const std::vector<std::string> goes_on{"--until", "2", "--restore", "state", "--out", "out"};
  const std::string message =
      "--out: out has the record of a run, which that of a run that goes on would replace; expected another folder";
  ASSERT_EQ(run({"--out", "out", "--save", "state"}).exit, 0);
  const std::string first = folder.read("out/endpoint_pose.csv");
  expect_error(run(goes_on), 2, message);
  EXPECT_EQ(folder.read("out/endpoint_pose.csv"), first);
  std::filesystem::remove(folder.path() / "out/run.json");  // as after a run that was killed
  std::filesystem::rename(folder.path() / "out/endpoint_pose.csv", folder.path() / "out/endpoint_pose.csv.part");
  expect_error(run(goes_on), 2, message);
  EXPECT_EQ(folder.read("out/endpoint_pose.csv.part"), first);
  const auto elsewhere = run({"--until", "2", "--restore", "state", "--out", "rest"});
  EXPECT_EQ(elsewhere.exit, 0) << elsewhere.err;
}

TEST_F(WrittenFiles, AreNoOtherWorld) {
  std::filesystem::create_directory(folder.path() / "other");
  folder.write("other/world.xml", world_of(""));
  refused({"diagnose", "world.xml", "--data", "data.csv", "--out", "other"},
          "--out: other has a world.xml that no diagnosis has written; expected a new folder, or that of an earlier "
          "diagnosis");
}

TEST_F(WrittenFiles, FolderOfASaveIsLookedForBeforeTheRun) {
  expect_error(folder.muster({"run", "world.xml", "--save", "none/state", "--plugins", MUSTER_TOYS}), 74,
               "none/state: cannot be written: No such file or directory");
}

// What was written until then is kept, and the state is saved all the same.
TEST_F(WrittenFiles, BeyondTheLimitOfTheirSizeAreAnError) {
  folder.write("long.xml",
               "<world name=\"w\" dt=\"0.1\" until=\"10000\"><station name=\"a\" at=\"0 0 1\"/><test.good/>"
               "<record table=\"endpoint/*/pose\"/></world>");
  Surroundings limited;
  limited.wrapper = {"/bin/bash", "-c", "ulimit -f 2000; exec \"$@\"", "--"};  // [kB]
  const auto outcome =
      folder.muster({"run", "long.xml", "--out", "out", "--save", "state", "--plugins", MUSTER_TOYS}, limited);
  EXPECT_EQ(outcome.exit, 74) << outcome.err;
  const std::string part = "out/endpoint_pose.csv.part";
  EXPECT_NE(outcome.err.find("cannot be written: File too large; what was written until then is in " + part),
            outcome.err.npos)
      << outcome.err;
  EXPECT_GT(std::filesystem::file_size(folder.path() / part), 1'000'000u);
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "state"));
}

}  // namespace
