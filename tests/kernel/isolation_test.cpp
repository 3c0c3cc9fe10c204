// Instances that step in processes of their own: the same bits, and what ends such a process ends nothing else.
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <thread>

#include "busy_world.hpp"
#include "kernel/separate_process.hpp"
#include "tests/sanitized.hpp"

namespace muster {
namespace {

using namespace std::chrono_literals;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;

constexpr int ticks = 40;

class Isolated : public ToyWorld {
 protected:
  Simulation isolated(const std::string& elements, const Isolations& how, int workers = 1) const {
    Options given = options(workers);
    given.isolated = how;
    return {world(elements), standard(), given};
  }
  Simulation ending(const std::string& how, AfterCrash after, const std::string& more = "") const {
    return isolated(busy_world + "<toy.ends name='mine' how='" + how + "' " + more + "/>\n", {{"mine", {after, 1s}}});
  }
  uint64_t digest_of(Simulation sim) const {
    step(sim, ticks);
    return sim.digest();
  }
  const std::string harmless = busy_world + "<toy.ends name='mine'/>\n";
};

TEST_F(Isolated, TakesTheSameStepsAsInTheProcess) {
  const uint64_t expected = digest_of(run(busy_world));
  EXPECT_EQ(digest_of(isolated(busy_world, {{"*", {}}})), expected);
  EXPECT_EQ(digest_of(isolated(busy_world, {{"*", {}}}, 3)), expected);
  for (const char* one : {"j", "l", "send", "send2", "hear", "noise", "kinds", "own", "rush"})
    EXPECT_EQ(digest_of(isolated(busy_world, {{one, {}}})), expected) << one;
}

TEST_F(Isolated, GoesOnTheSameAfterWhatChangesTheRun) {
  Simulation plain = run(busy_world), apart = isolated(busy_world, {{"*", {}}});
  const auto both = [&](auto&& change) { change(plain), change(apart); };
  both([](Simulation& sim) { step(sim, 9); });
  const Snapshot saved = plain.snapshot();
  both([](Simulation& sim) { step(sim, 12), sim.remake("move"), sim.set_parameter("far/add", -3); });
  both([](Simulation& sim) { step(sim, 3), sim.insert(instance("toy.version", "v")), step(sim, 3), sim.remove("v"); });
  both([](Simulation& sim) { sim.join("robot", "evening", "a"), step(sim, 5); });
  EXPECT_EQ(plain.digest(), apart.digest());
  both([&](Simulation& sim) { sim.restore(saved), sim.join("robot", "morning", "b"), step(sim, 10); });
  EXPECT_EQ(plain.digest(), apart.digest());
}

// Their number changes each tick, in the process of the run.
TEST_F(Isolated, KnowsTheRowsOfListedSets) {
  const std::string asking = two_robots + "<material name='m' loss='2'/>\n<material name='n' loss='2'/>\n" +
                             "<toy.list name='l'/>\n<toy.ask name='ask'/>\n";
  Simulation sim = isolated(asking, {{"ask", {}}});
  for (int tick = 1; tick < 8; ++tick) {
    step(sim);
    EXPECT_EQ(cell(sim, "robot/*/asked", 5), tick % 5 + 1);
  }
}

TEST_F(Isolated, TellsWhatItTellsInTheProcess) {
  const std::string faults = two_robots +
                             "<material name='m' loss='2'/>\n<material name='n' loss='2'/>\n<toy.fault name='f' "
                             "fault='throws'/>\n<toy.ask name='ask'/>\n";
  const auto told = [&](Simulation sim) {
    const std::string error = error_of([&] { step(sim, 5); });
    return std::pair{error, messages(sim)};
  };
  EXPECT_EQ(told(isolated(faults, {{"*", {}}})), told(run(faults)));
  for (const char* fault : {"nan", "fails", "refuses", "says_and_returns", "appends", "puts", "claims", "rounds"}) {
    const std::string one = two_robots + "<toy.fault name='f' fault='" + fault + "'/>\n";
    EXPECT_EQ(told(isolated(one, {{"*", {}}})), told(run(one))) << fault;
  }
}

TEST_F(Isolated, EndOfItsProcessEndsTheRunWithItsName) {
  const auto ends = [&](const std::string& how) {
    Simulation sim = ending(how, AfterCrash::stop);
    step(sim, 2);
    const uint64_t before = sim.digest();
    const std::string error = error_of([&] { step(sim); });
    EXPECT_EQ(sim.digest(), before) << how;  // the state of the tick before
    EXPECT_THAT(error, AllOf(HasSubstr("mine (toy.ends): step failed at tick 3 (t = 1.5 s): its own process "))) << how;
    return error.substr(error.find("process ") + 8);
  };
  if (!test::sanitized) {
    EXPECT_EQ(ends("segfault"), "ended with a segmentation fault (SIGSEGV)");
    EXPECT_EQ(ends("thread"), "ended with a segmentation fault (SIGSEGV)");
    EXPECT_EQ(ends("abort"), "ended with an abort (SIGABRT)");
    EXPECT_EQ(ends("exit"), "ended with exit(0)");
  }
  EXPECT_EQ(ends("kill"), "ended with a kill from outside (SIGKILL)");
  EXPECT_EQ(ends("loop"), "had not returned after 1 s and was ended");
}

TEST_F(Isolated, AnotherProcessTakesTheStepAgain) {
  const auto once = put("once", "");
  Simulation sim = ending("kill", AfterCrash::restart, "once='" + once.string() + "'");
  step(sim, ticks);
  EXPECT_FALSE(std::filesystem::exists(once));
  EXPECT_EQ(cell(sim, "instance/mine/count"), ticks);  // none twice
  EXPECT_THAT(messages(sim), Contains("3 mine: warning: its own process ended with a kill from outside (SIGKILL); "
                                      "another one takes this step"));
  Simulation plain = run(harmless);
  step(plain, ticks);
  for (const auto& [name, table] : plain.board().tables()) {
    EXPECT_EQ(sim.board().find(name)->now().data.size(), table->now().data.size());
    for (std::size_t i = 0; i < table->now().data.size(); ++i)
      EXPECT_TRUE(same_bits(sim.board().find(name)->now().data[i], table->now().data[i])) << name;
  }
}

TEST_F(Isolated, RunEndsWhereTheOtherProcessEndsToo) {
  Simulation sim = ending("kill", AfterCrash::restart);
  EXPECT_THAT(
      error_of([&] { step(sim, ticks); }),
      HasSubstr("ended with a kill from outside (SIGKILL), and so did the one that took its place in this step"));
}

TEST_F(Isolated, RunGoesOnWithoutIt) {
  Simulation sim = ending("kill", AfterCrash::without), plain = run(harmless);
  step(sim, ticks), step(plain, ticks);
  EXPECT_EQ(cell(sim, "instance/mine/count"), 2);
  EXPECT_EQ(column(sim, "robot/*/pose"), column(plain, "robot/*/pose"));
  EXPECT_THAT(messages(sim), Contains(HasSubstr("3 mine: warning: its own process ended with a kill from outside "
                                                "(SIGKILL); the run goes on without it")));
}

TEST_F(Isolated, RunGoesOnWithoutItFromASavedState) {
  Simulation sim = ending("kill", AfterCrash::without), fresh = ending("kill", AfterCrash::without);
  step(sim, 2);
  const Snapshot before = sim.snapshot();
  step(sim, 2);
  sim.snapshot().save(folder / "saved");
  step(sim, 6);
  const Snapshot saved = Snapshot::load(folder / "saved");
  fresh.restore(saved);
  step(fresh, 6);
  EXPECT_EQ(fresh.digest(), sim.digest());
  EXPECT_EQ(cell(fresh, "instance/mine/count"), 2);
  fresh.restore(before);  // it is there again, and ends again
  step(fresh, 2);
  EXPECT_THAT(messages(fresh), Contains(HasSubstr("3 mine: warning: its own process ended with a kill from outside")));
  Simulation strict = ending("kill", AfterCrash::restart), plain = run(busy_world + "<toy.ends name='mine'/>\n");
  for (Simulation* other : {&strict, &plain})
    EXPECT_EQ(error_of([&] { other->restore(saved); }),
              "the run that was saved goes on without \"mine\", whose process had ended; expected --isolate "
              "mine=without here, too");
}

// Ends all processes that this one has begun and that have not ended.
int end_children() {
  int ended = 0;
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    std::ifstream stat(entry.path() / "stat");
    int pid = 0, parent = 0;
    std::string name, state;
    if (stat >> pid >> name >> state >> parent && parent == ::getpid() && state != "Z")
      ended += ::kill(pid, SIGKILL) == 0;
  }
  return ended;
}

// What a stage was given passes, a part of a sum stays, and so do the cells and rows that others wrote.
TEST_F(Isolated, WithoutWritersOfEveryKindTheirValuesStay) {
  Options given = options();
  const std::vector<std::string> names{"clip", "walls", "noise", "l", "send", "kinds", "rush", "cells", "j"};
  for (const std::string& one : names) given.isolated[one] = {AfterCrash::without, 30s};
  Simulation sim(world(busy_world), standard(), given);
  step(sim, 3);
  EXPECT_GT(cell(sim, "outbox/*/message"), -1);
  const auto kept = [&] {
    return std::vector{column(sim, "link/*/level@walls"), column(sim, "robot/b/pose"), column(sim, "robot/*/kinds")};
  };
  const auto before = kept();
  const std::size_t listed = sim.board().find_set("endpoint")->rows();
  EXPECT_EQ(end_children(), static_cast<int>(names.size()));
  step(sim, 12);
  EXPECT_EQ(kept(), before);
  EXPECT_EQ(sim.board().find_set("endpoint")->rows(), listed);
  EXPECT_EQ(column(sim, "robot/*/command"), column(sim, "robot/*/command@base"));
  EXPECT_EQ(std::ranges::count_if(messages(sim), [](const auto& m) { return m.find("without it") != m.npos; }),
            static_cast<int>(names.size()));
}

TEST_F(Isolated, WritesNowhereElse) {
  const uint64_t expected = digest_of(run(harmless));
  EXPECT_NE(digest_of(run(busy_world + "<toy.ends name='mine' how='reaches' tick='20'/>\n")),
            expected);  // in the process
  const mode_t before = ::umask(022);
  Simulation sim = ending("reaches", AfterCrash::stop, "tick='20'"), other = ending("umask", AfterCrash::stop);
  step(sim, ticks), step(other, ticks);
  EXPECT_EQ(::umask(before), 022);
  Simulation plain = run(harmless);
  step(plain, ticks);
  EXPECT_EQ(column(sim, "robot/*/pose"), column(plain, "robot/*/pose"));
}

TEST_F(Isolated, APluginThatIsLoadedAgainStepsThereToo) {
  const mode_t before = ::umask(022);
  Simulation sim = ending("umask", AfterCrash::stop);
  step(sim, 2);
  sim.reload("mine");
  EXPECT_EQ(error_of([&] { step(sim, 2); }), "no error");
  EXPECT_EQ(::umask(before), 022);
}

TEST_F(Isolated, CreateAndDestroyAreTriedInProcessesOfTheirOwn) {
  EXPECT_THAT(error_of([&] { ending("kill", AfterCrash::stop, "where='create'"); }),
              HasSubstr("mine (toy.ends): create failed: its own process ended with a kill from outside (SIGKILL)"));
  const test::LeftBehind plugin;  // that died as it was to be destroyed
  Simulation sim = ending("kill", AfterCrash::stop, "where='destroy'");
  step(sim, 2);
  EXPECT_THAT(error_of([&] { sim.close(); }),
              HasSubstr("mine (toy.ends): destroy failed: its own process ended with a kill from outside (SIGKILL)"));
}

TEST_F(Isolated, RowsMayBeManyMoreThanBefore) {
  const std::string many = two_robots +
                           "<toy.send_control name='s' robot='a' to='outbox/{robot}/message' count='60' "
                           "size='20000'/>\n<toy.listen_control name='h'/>\n";
  EXPECT_EQ(digest_of(isolated(many, {{"*", {}}})), digest_of(run(many)));
}

TEST_F(Isolated, WhatWaitsForOthersStepsInTheProcessOfTheRun) {
  const std::string waiting = two_robots + "<toy.wait_outside name='out'/>\n<toy.wait_here name='here'/>\n";
  const std::string why = "a connection to what it waits for would end with a process of its own";
  Simulation sim = isolated(waiting, {{"*", {}}});
  step(sim);
  EXPECT_EQ(cell(sim, "instance/out/where"), ::getpid());
  EXPECT_NE(cell(sim, "instance/here/where"), ::getpid());
  EXPECT_THAT(messages(sim), Contains("0 out: note: steps in the process of the run: " + why));
  EXPECT_EQ(
      error_of([&] {
        isolated(waiting, {{"out", {}}});
      }),
      "world.xml:4:1: out (toy.wait_outside): cannot be isolated: " + why + "; expected --isolate without its name");
}

TEST_F(Isolated, NameIsThatOfAnInstance) {
  EXPECT_EQ(error_of([&] {
              isolated(busy_world, {{"clipp", {}}});
            }),
            "no instance is called \"clipp\"; expected one of ask, clip, move, rush, cells, j, l, walls, far, near, "
            "sum, sum2, send, send2, hear, late, draw, noise, kinds, own; did you mean \"clip\"?");
}

TEST(SeparateProcess, ServesCallsUntilItEnds) {
  SeparateProcess doubled(8, [](std::byte* memory) { *reinterpret_cast<int*>(memory) *= 2; });
  auto& number = *reinterpret_cast<int*>(doubled.memory());
  number = 3;
  EXPECT_EQ(doubled.call(10s), "");
  EXPECT_EQ(number, 6);
  std::this_thread::sleep_for(20ms);  // both sleep by now
  EXPECT_EQ(doubled.call(10s), "");
  EXPECT_EQ(number, 12);
  SeparateProcess ends(8, [](std::byte*) { ::_exit(3); });
  EXPECT_EQ(ends.call(10s), "ended with exit(3)");
  EXPECT_EQ(ends.call(10s), "has ended");
}

TEST(SeparateProcess, EndsAlsoWhereItsEndIsIgnored) {
  const auto before = std::signal(SIGCHLD, SIG_IGN);
  SeparateProcess ends(8, [](std::byte*) { ::_exit(3); });
  EXPECT_EQ(ends.call(10s), "has ended");
  EXPECT_EQ(ends.call(10s), "has ended");
  std::signal(SIGCHLD, before);
}

}  // namespace
}  // namespace muster
