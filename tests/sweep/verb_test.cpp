// What a sweep runs is what `muster run` runs, once, however it is shared.
#include <cmath>
#include <thread>

#include "swept.hpp"
#include "tests/sanitized.hpp"

namespace muster::test {
namespace {

using testing::HasSubstr;

TEST(Sweep, RunsWhatASingleRunOfTheSameWordsRuns) {
  const SweepFolder folder;
  folder.write_sweep(
      "<vary instance=\"network.ideal\" plugins=\"network.ideal network.lrwpan\"/><metric of=\"moved\"/>"
      "<metric of=\"robot/r/pose/x\"/><metric of=\"robot/r/pose/x\" take=\"least\"/>"
      "<metric of=\"robot/r/pose/x\" take=\"mean\"/>");
  const auto outcome = folder.sweep({"plan.xml", "--out", "out"});
  ASSERT_EQ(outcome.exit, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("plan: 6 combinations of 4 seeds, 24 runs, 0 of them done before"));
  const auto runs = TextTable::read(folder.path() / "out" / "runs.csv");
  ASSERT_EQ(runs.rows(), 24u);
  std::set<std::string> digests;
  const std::size_t digest = runs.require("digest", ""), power = runs.require("radio.multiwall/tx_power", ""),
                    seed = runs.require("seed", ""), network = runs.require("network.ideal", "");
  for (std::size_t i = 0; i < runs.rows(); ++i) digests.insert(runs.text(i, digest));
  EXPECT_EQ(digests.size(), 24u);
  for (const std::size_t row : {0, 9, 18}) {  // of network.ideal, the world's own
    ASSERT_EQ(runs.text(row, network), "network.ideal");
    const auto single = folder.muster({"run", "world.xml", "--json", "--seed", runs.text(row, seed), "--set",
                                       "radio.multiwall/tx_power=" + runs.text(row, power)});
    ASSERT_EQ(single.exit, 0) << single.err;
    EXPECT_EQ(nlohmann::json::parse(single.out)["digest"], runs.text(row, digest)) << row;
  }
  // A robot that drives east: x grows from 30 m, and what it moved is that growth.
  const auto x = runs.reals(runs.require("robot/r/pose/x", "m")), moved = runs.reals(runs.require("moved", "m")),
             least = runs.reals(runs.require("least of robot/r/pose/x", "m")),
             mean = runs.reals(runs.require("mean of robot/r/pose/x", "m"));
  EXPECT_GT(x[0], 30.1);
  EXPECT_NEAR(moved[0], x[0] - 30, 0.02);
  EXPECT_LT(least[0], mean[0]);
  EXPECT_LT(mean[0], x[0]);
}

TEST(Sweep, OneSeedThatMayBeMeantAsANumberOfSeedsIsNoted) {
  const SweepFolder folder;
  const auto swept = [&](const std::string& seeds) {
    folder.write("plan.xml", "<sweep world=\"world.xml\" seeds=\"" + seeds + "\"/>");
    return folder.sweep({"plan.xml", "--out", "out" + seeds});
  };
  const auto one = swept("20");
  EXPECT_EQ(one.err,
            "muster: note: plan.xml:1:33: seeds=\"20\" is one seed, the number 20, so that there are no intervals; "
            "expected seeds=\"1..20\" for 20 seeds\n");
  EXPECT_THAT(one.out, HasSubstr("plan: 1 combinations of 1 seed, 1 runs, 0 of them done before"));
  EXPECT_EQ(swept("1").err, "");
  EXPECT_EQ(swept("3 20").err, "");
}

TEST(Sweep, SweepsWorlds) {
  const SweepFolder folder;
  folder.write("other.xml", folder.read("world.xml").replace(folder.read("world.xml").find("30 3 0"), 6, "40 3 0"));
  folder.write("plan.xml",
               "<sweep seeds=\"1 2\"><vary worlds=\"world.xml other.xml\"/><metric of=\"robot/r/pose/x\"/></sweep>");
  ASSERT_EQ(folder.sweep({"plan.xml", "--out", "out"}).exit, 0);
  const auto table = TextTable::read(folder.path() / "out" / "summary.csv");
  EXPECT_NEAR(table.reals(table.require("difference", ""), {.empty = true})[1], 10,
              0.01);  // both drive to the same far point
  EXPECT_EQ(table.text(1, table.require("world", "")), "other.xml");
}

// The last cells of a row that has left were counted on.
TEST(Sweep, MetricsLeaveOutRobotsThatHaveLeft) {
  const SweepFolder folder;
  folder.write(
      "left.xml",
      "<world name=\"left\" dt=\"0.1\" until=\"2\"><robot name=\"r\" at=\"0 0 0\"/><robot name=\"s\" at=\"10 0 0\"/>"
      "<physics.planar/><control.waypoint robot=\"s\" path=\"way.csv\" speed=\"0.3\"/>"
      "<at t=\"1\"><leave robot=\"s\"/></at></world>");
  folder.write("plan.xml",
               "<sweep world=\"left.xml\" seeds=\"1 2\"><metric of=\"moved\"/><metric of=\"robot/*/pose/x\"/>"
               "<metric of=\"robot/s/pose/x\"/><metric of=\"robot/s/pose/x\" take=\"most\"/></sweep>");
  const auto outcome = folder.sweep({"plan.xml", "--out", "out"});
  ASSERT_EQ(outcome.exit, 0) << outcome.err;
  const auto runs = TextTable::read(folder.path() / "out" / "runs.csv");
  const auto first = [&](const std::string& column) {
    return runs.reals(runs.require(column, "m"), {.empty = true})[0];
  };
  EXPECT_NEAR(first("moved"), 0, 1e-9) << "r stays where it is";
  EXPECT_NEAR(first("robot/*/pose/x"), 0, 1e-9);
  EXPECT_TRUE(std::isnan(first("robot/s/pose/x")));
  EXPECT_GT(first("most of robot/s/pose/x"), 10.1) << "while it was there";
}

TEST(Sweep, TheSameAgainRunsNothing) {
  const SweepFolder folder;
  folder.write_sweep();
  const auto first = folder.sweep({"plan.xml", "--out", "out", "--json"});
  ASSERT_EQ(first.exit, 0) << first.err;
  const std::string tables = folder.tables("out");
  const auto second = folder.sweep({"plan.xml", "--out", "out", "--json"});
  EXPECT_EQ(first.out, second.out);
  EXPECT_EQ(folder.tables("out"), tables);
  EXPECT_EQ(folder.ask("out", "SELECT sum(begun) FROM job"), 12);
  EXPECT_THAT(folder.sweep({"plan.xml", "--out", "out"}).out, HasSubstr("12 runs, 12 of them done before"));
  const auto told = nlohmann::json::parse(first.out);
  EXPECT_EQ(told["combinations"].size(), 3u);
  EXPECT_EQ(told["combinations"][2]["values"]["radio.multiwall/tx_power"], "-8");
}

TEST(Sweep, HoweverItIsSharedTheTableIsTheSame) {
  const SweepFolder folder;
  folder.write_sweep();
  ASSERT_EQ(folder.sweep({"plan.xml", "--out", "alone"}).exit, 0);
  ASSERT_EQ(folder.sweep({"plan.xml", "--out", "jobs", "--jobs", "3", "--workers", "2"}).exit, 0);
  std::vector<std::thread> shares;
  std::vector<Outcome> ended(5);
  for (int i = 1; i <= 5; ++i)
    shares.emplace_back([&, i] {
      ended[static_cast<std::size_t>(i - 1)] =
          folder.sweep({"plan.xml", "--out", "shares", "--index", std::to_string(i), "--of", "5"});
    });
  for (auto& share : shares) share.join();
  for (const auto& outcome : ended) EXPECT_EQ(outcome.exit, 0) << outcome.err;
  EXPECT_THAT(ended[0].out, HasSubstr("share 1 of 5: 3 runs, all done"));
  EXPECT_EQ(folder.tables("jobs"), folder.tables("alone"));
  EXPECT_EQ(folder.tables("shares"), folder.tables("alone"));
  EXPECT_EQ(folder.ask("shares", "SELECT max(begun) FROM job"), 1);
}

// Some supervisors start programs so.
TEST(Sweep, EndsWhereTheEndsOfChildrenAreIgnored) {
  const SweepFolder folder;
  folder.write_sweep();
  Surroundings around;
  around.wrapper = {"env", "--ignore-signal=CHLD"};
  const auto outcome = folder.sweep({"plan.xml", "--out", "out", "--jobs", "2"}, around);
  EXPECT_EQ(outcome.exit, 0) << outcome.err;
  EXPECT_EQ(folder.ask("out", "SELECT count(*) FROM run"), 12);
}

TEST(Sweep, AShareDoesItsOwnRunsAlone) {
  const SweepFolder folder;
  folder.write_sweep();
  const auto outcome = folder.sweep({"plan.xml", "--out", "out", "--index", "2", "--of", "4"});
  EXPECT_EQ(outcome.exit, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "share 2 of 4: 3 runs, all done; 3 of 12 in all\n");
  EXPECT_EQ(folder.ask("out", "SELECT count(*) FROM run WHERE job % 4 = 1"), 3);
  EXPECT_EQ(folder.ask("out", "SELECT count(*) FROM run"), 3);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out" / "summary.csv"));
}

TEST(Sweep, PrintsTheCommandsOfShares) {
  const SweepFolder folder;
  folder.write_sweep();
  const auto commands = folder.sweep({"plan.xml", "--out", "an out", "--parallel", "3", "--jobs", "2"});
  ASSERT_EQ(commands.exit, 0) << commands.err;
  const auto shell = [&](const std::string& text) {
    return std::system(("cd / && " + text + " >/dev/null").c_str());  // they hold from any folder
  };
  std::istringstream lines(commands.out);
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) EXPECT_EQ(shell(line), 0) << line;
  EXPECT_EQ(count, 3);
  EXPECT_EQ(folder.ask("an out", "SELECT count(*) FROM run"), 12);
  const auto script = folder.sweep({"plan.xml", "--out", "array", "--slurm", "2"});
  EXPECT_THAT(script.out, HasSubstr("#!/bin/sh\n#SBATCH --job-name=sweep_plan\n#SBATCH --array=1-2\n"));
  const auto file = folder.write("script", script.out).string();
  for (const char* task : {"1", "2"}) EXPECT_EQ(shell("SLURM_ARRAY_TASK_ID=" + std::string(task) + " sh " + file), 0);
  EXPECT_EQ(folder.tables("array"), folder.tables("an out"));
}

// All of its combinations are made, and one of its runs is run.
TEST(Sweep, TheSampleOfThePage) {
  const SweepFolder folder;
  const auto outcome = folder.sweep(
      {MUSTER_SOURCE_DIR "/docs/samples/sweep/routing.xml", "--out", "out", "--index", "200", "--of", "240"});
  EXPECT_EQ(outcome.exit, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "share 200 of 240: 1 runs, all done; 1 of 240 in all\n");
  EXPECT_EQ(folder.ask("out", "SELECT count(*) FROM value WHERE value > 0"),
            2);  // by aodv, messages arrive and are relayed
}

// A run that fails is told and counted, and is no reason to leave out the others.
TEST(Sweep, ARunThatFailsIsToldOnceAndDoneOnce) {
  const SweepFolder folder;
  folder.write("world.xml",
               "<world name=\"w\" dt=\"0.1\" until=\"2\"><robot name=\"r\" at=\"0 0 0\"/><physics.planar/>"
               "<control.waypoint name=\"steer\" robot=\"r\" path=\"way.csv\"/></world>");
  const std::string base = folder.read("world.xml");
  folder.write("broken.xml",
               std::string(base).replace(base.find("<control"), 0, "<test.throws_in_step name=\"bad\"/>"));
  folder.write("plan.xml",
               "<sweep seeds=\"1 2\"><vary worlds=\"world.xml broken.xml\"/><metric of=\"moved\"/></sweep>");
  for (int time = 0; time < 2; ++time) {
    const auto outcome = folder.sweep({"plan.xml", "--out", "out", "--plugins", MUSTER_TOYS});
    EXPECT_EQ(outcome.exit, 3);
    EXPECT_THAT(outcome.err, HasSubstr("2 of 4 runs failed; the first, seed 1 of combination 2: "));
    EXPECT_THAT(outcome.err, HasSubstr("the shelf is empty"));
  }
  EXPECT_EQ(folder.ask("out", "SELECT sum(begun) FROM job"), 4);
  const auto table = TextTable::read(folder.path() / "out" / "summary.csv");
  const auto runs = table.reals(table.require("runs", ""));
  EXPECT_EQ(runs[0], 2);
  EXPECT_EQ(runs[1], 0);
}

// A plugin that crashes takes its worker with it, and no more: the other runs are done, and it is told which are not.
TEST(Sweep, ARunThatCrashesHoldsUpNoOther) {
  if (sanitized) GTEST_SKIP() << "a sanitizer reports the fault in its own words, and ends the worker otherwise";
  const SweepFolder folder;
  const std::string base = folder.read("world.xml");
  folder.write("crash.xml", std::string(base).replace(base.find("</world>"), 0, "<test.crash/>"));
  folder.write("plan.xml",
               "<sweep seeds=\"1..3\"><vary worlds=\"crash.xml world.xml\"/><metric of=\"moved\"/></sweep>");
  const auto outcome = folder.sweep({"plan.xml", "--out", "out", "--plugins", MUSTER_CRASH});
  EXPECT_EQ(outcome.exit, 1) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("a segmentation fault (SIGSEGV) in the plugin"));
  EXPECT_THAT(outcome.err, HasSubstr("muster: warning: a worker was ended by signal 11 (Segmentation fault)"));
  EXPECT_THAT(outcome.err, HasSubstr("3 of 6 runs are done; the same command goes on with the others"));
  EXPECT_THAT(outcome.err, HasSubstr("seed 2 of combination 1 was left by a worker that is no more"));
  EXPECT_EQ(folder.ask("out", "SELECT count(*) FROM run WHERE job >= 3"), 3);
}

TEST(Sweep, ACombinationWhoseMakingCrashesIsToldBeforeTheFirstRun) {
  const SweepFolder folder;
  const std::string base = folder.read("world.xml");
  folder.write("world.xml", std::string(base).replace(base.find("</world>"), 0, "<test.aborts_in_create/>"));
  folder.write_sweep();
  const auto outcome = folder.sweep({"plan.xml", "--out", "out", "--plugins", MUSTER_ABORT});
  EXPECT_EQ(outcome.exit, 3);
  EXPECT_THAT(outcome.err, HasSubstr("an abort (SIGABRT) in the plugin"));
  EXPECT_THAT(outcome.err, HasSubstr("muster: error: plan.xml: a combination could not be made\n"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out"));
}

// What a worker was doing that is no more is done by the next.
TEST(Sweep, AClaimOfTheDeadIsTakenOver) {
  const SweepFolder folder;
  folder.write_sweep();
  ASSERT_EQ(folder.sweep({"plan.xml", "--out", "out", "--index", "1", "--of", "12"}).exit, 0);
  // As if a worker had died in the second run: the claim of one that holds no lock.
  muster::sweep::Database(folder.path() / "out" / "sweep.sqlite")
      .run("INSERT INTO worker VALUES (77); UPDATE job SET worker = 77, begun = 1 WHERE number = 1");
  muster::sweep::JobTable table(folder.path() / "out");
  ASSERT_EQ(table.left().size(), 1u);
  EXPECT_EQ(table.left()[0].seed, 2);
  const auto outcome = folder.sweep({"plan.xml", "--out", "out"});
  EXPECT_EQ(outcome.exit, 0) << outcome.err;
  EXPECT_EQ(folder.ask("out", "SELECT begun FROM job WHERE number = 1"), 2);
  EXPECT_EQ(folder.ask("out", "SELECT count(*) FROM run"), 12);
}

TEST(Sweep, AnInterruptLeavesTheRestForLater) {
  const SweepFolder folder;
  std::string world = folder.read("world.xml");
  folder.write("world.xml", world.replace(world.find("until=\"2\""), 9, "until=\"2000\""));
  folder.write_sweep();
  std::thread later;
  Surroundings around;
  around.environment = {"TERM=xterm"};
  around.terminal = true;
  around.meanwhile = [](int process) { ::kill(process, SIGINT); };
  const auto outcome = folder.sweep({"plan.xml", "--out", "out"}, around);
  EXPECT_EQ(outcome.exit, 130) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("of 12 runs are done; the same command goes on with the others"));
  EXPECT_EQ(folder.ask("out", "SELECT count(*) FROM job WHERE worker IS NOT NULL"), 0);
}

}  // namespace
}  // namespace muster::test
