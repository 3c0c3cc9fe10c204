// Queues: each reader sees each message once, whatever its period and place in the tick; owners see their own.
#include "toy_world.hpp"

namespace muster {
namespace {

using testing::ElementsAre;
using Queues = ToyWorld;

constexpr int ticks = 96;

// Messages received by a listener, against those of senders of `each` messages every `period` ticks up to `tick`.
void expect_all_once(const Simulation& sim, const std::string& listener, int each, int period, int tick,
                     bool from_0 = false) {
  double count = 0, first = -1, last = 0;
  for (int t = from_0 ? 0 : 1; t <= tick; ++t) {
    if (t % period) continue;
    count += each;
    if (first < 0) first = t * 100;
    last = t * 100 + each - 1;
  }
  EXPECT_EQ(cell(sim, "instance/" + listener + "/heard", 0), count) << listener;
  EXPECT_EQ(cell(sim, "instance/" + listener + "/heard", 2), first) << listener;
  EXPECT_EQ(cell(sim, "instance/" + listener + "/heard", 3), last) << listener;
}

class QueuePeriods : public ToyWorld, public testing::WithParamInterface<std::tuple<int, int>> {};

TEST_P(QueuePeriods, EveryReaderSeesEachMessageOnce) {
  const auto [sends, listens] = GetParam();
  const std::string every = " every='" + std::to_string(listens) + "'";
  Simulation sim =
      run(two_robots + "<toy.send_network name='s' robot='a' to='outbox/{robot}/message' count='3' every='" +
          std::to_string(sends) + "'/>\n<toy.listen_control name='before'" + every +
          "/>\n<toy.listen_network name='with'" + every + "/>\n<toy.listen_observe name='after'" + every + "/>\n");
  step(sim, ticks);
  expect_all_once(sim, "with", 3, sends, ticks);
  expect_all_once(sim, "after", 3, sends, ticks);
  expect_all_once(sim, "before", 3, sends, ticks - 1);
}
INSTANTIATE_TEST_SUITE_P(All, QueuePeriods,
                         testing::Combine(testing::Values(1, 2, 3, 8), testing::Values(1, 2, 4, 6, 16)));

class QueueFirstPass : public QueuePeriods {};

// The SENSE pass before the first tick appends, too.
TEST_P(QueueFirstPass, MessagesOfTheFirstSensePassAreSeenOnce) {
  const auto [sends, listens] = GetParam();
  const std::string every = " every='" + std::to_string(listens) + "'";
  Simulation sim =
      run(two_robots + "<toy.send_sense name='s' robot='a' to='outbox/{robot}/message' every='" +
          std::to_string(sends) + "'/>\n<toy.listen_control name='before'" + every +
          "/>\n<toy.listen_sense name='with'" + every + "/>\n<toy.listen_observe name='after'" + every + "/>\n");
  step(sim, ticks);
  expect_all_once(sim, "with", 1, sends, ticks, true);
  expect_all_once(sim, "after", 1, sends, ticks, true);
  expect_all_once(sim, "before", 1, sends, ticks - 1, true);
}
INSTANTIATE_TEST_SUITE_P(All, QueueFirstPass, testing::Combine(testing::Values(1, 2, 8), testing::Values(1, 4, 16)));

TEST_F(Queues, ReadersOfDifferentPeriodsShareOneQueue) {
  Simulation sim = run(two_robots +
                       "<toy.send_network name='s' robot='a' to='outbox/{robot}/message' every='3'/>\n"
                       "<toy.listen_observe name='often'/>\n<toy.listen_control name='seldom' every='12'/>\n");
  step(sim, ticks + 12);
  expect_all_once(sim, "often", 1, 3, ticks + 12);
  expect_all_once(sim, "seldom", 1, 3, ticks + 11);
}

TEST_F(Queues, WhatEverybodyHasSeenIsGone) {
  Simulation sim = run(two_robots +
                       "<toy.send_network name='s' robot='a' to='outbox/{robot}/message' count='2'/>\n"
                       "<toy.listen_control name='r' every='4'/>\n");
  for (int i = 0; i < 50; ++i) {
    step(sim);
    EXPECT_LE(sim.table("outbox/*/message").rows(), 2u * 5);
  }
}

TEST_F(Queues, OwnersSeeTheirOwn) {
  Simulation sim = run(two_robots +
                       "<toy.send_control name='sa' robot='a' to='outbox/{robot}/message' count='2'/>\n"
                       "<toy.send_control name='sb' robot='b' to='outbox/{robot}/message' count='5'/>\n"
                       "<toy.listen_network name='ra' robot='a' from='outbox/{robot}/message'/>\n"
                       "<toy.listen_network name='rb' robot='b' from='outbox/{robot}/message'/>\n"
                       "<toy.listen_network name='all'/>\n");
  step(sim, 10);
  EXPECT_EQ(cell(sim, "instance/ra/heard"), 20);
  EXPECT_EQ(cell(sim, "instance/rb/heard"), 50);
  EXPECT_EQ(cell(sim, "instance/all/heard"), 70);
}

TEST_F(Queues, NobodySpeaksForAnother) {
  Simulation sim = run(two_robots + "<toy.send_control name='sa' robot='a' to='outbox/{robot}/message' as='1'/>\n");
  EXPECT_EQ(error_of([&] { sim.step(); }),
            "3 world.xml:4:1: sa (toy.send_control): step failed at tick 1 (t = 0.5 s): outbox/a/message: radio is 1, "
            "which is b, but it speaks for a alone; expected \"radio\" to be left as send() and append() fill it in, "
            "and whom it is for in \"to\" (null(): all)");
}

TEST_F(Queues, WritersOfSeveralPhasesAndAReaderAmongThem) {
  Simulation sim = run(two_robots +
                       "<toy.send_control name='one' robot='a' to='outbox/{robot}/message'/>\n"
                       "<toy.send_sense name='two' robot='b' to='outbox/{robot}/message'/>\n"
                       "<toy.listen_network name='between'/>\n<toy.listen_observe name='after'/>\n");
  step(sim, 20);
  EXPECT_EQ(cell(sim, "instance/after/heard"), 41);    // one message of the SENSE pass before the first tick
  EXPECT_EQ(cell(sim, "instance/between/heard"), 39);  // what came this tick is published at its last writer's phase
}

TEST_F(Queues, WhoAnswersIntoTheQueueThatItReadsSeesEachMessageOnce) {
  Simulation sim = run(two_robots +
                       "<toy.send_control name='s' robot='a' to='outbox/{robot}/message'/>\n"
                       "<toy.listen_network name='echo' answers='true'/>\n<toy.listen_observe name='all'/>\n");
  step(sim, 20);
  EXPECT_EQ(cell(sim, "instance/all/heard"), 20 + 19);  // an answer to each message but the last
  EXPECT_EQ(cell(sim, "instance/echo/heard"), 19 + 18);
}

// ---- Stages -------------------------------------------------------------------------------------------------------

class QueueStages : public ToyWorld, public testing::WithParamInterface<std::string> {};

// For any phase of the stage: that of the messages' writer or a later one.
TEST_P(QueueStages, EveryReaderSeesEachMessageOnceBeforeAStageAndAfterIt) {
  const std::string readers =
      "<toy.listen_control name='early'/>\n<toy.listen_network name='with'/>\n<toy.listen_network name='seldom' "
      "every='3'/>\n<toy.listen_observe name='after'/>\n<toy.listen_network name='raw' "
      "from='outbox/*/message@base'/>\n";
  Simulation sim = run(two_robots + "<toy.send_control name='s' robot='a' to='outbox/{robot}/message' count='3'/>\n" +
                       "<toy.relay_" + GetParam() + " name='relay'/>\n" + readers);
  step(sim, ticks);
  const bool is_late = GetParam() == "sense", is_early = GetParam() == "control";
  const auto heard = [&](const std::string& who, std::size_t what) {
    return cell(sim, "instance/" + who + "/heard", what);
  };
  for (const auto& [who, seen] : std::map<std::string, int>{
           {"early", ticks - !is_early}, {"with", ticks - is_late}, {"seldom", ticks - is_late}, {"after", ticks}}) {
    EXPECT_EQ(heard(who, 0), 3 * seen) << who;
    EXPECT_EQ(heard(who, 2), 10'000'100) << who;
    EXPECT_EQ(heard(who, 3), 10'000'002 + 100 * seen) << who;
  }
  expect_all_once(sim, "raw", 3, 1, ticks);
  EXPECT_LE(sim.table("outbox/*/message@base").rows(), 3u);
  EXPECT_LE(sim.table("outbox/*/message").rows(), 3u * 4);
}
INSTANTIATE_TEST_SUITE_P(All, QueueStages, testing::Values("control", "actuate", "network", "sense"));

TEST_F(Queues, StagesFollowEachOther) {
  Simulation sim =
      run(two_robots +
          "<toy.send_control name='s' robot='a' to='outbox/{robot}/message'/>\n<toy.relay_sense name='one'/>\n"
          "<toy.relay_observe name='two'/>\n<toy.listen_observe name='all'/>\n");
  step(sim, 20);
  EXPECT_EQ(cell(sim, "instance/all/heard"), 20);
  EXPECT_EQ(cell(sim, "instance/all/heard", 3), 20'002'000);
}

TEST_F(Queues, AStageDoesNotGoInMidRunButIsSwapped) {
  Simulation sim =
      run(two_robots +
          "<toy.send_control name='s' robot='a' to='outbox/{robot}/message'/>\n<toy.relay_sense name='relay'/>\n"
          "<toy.listen_network name='all'/>\n");
  step(sim, 4);
  const std::string refused =
      "the stages of the queue \"outbox/*/message\" change in mid-run; expected them to stand from the start, and one "
      "to be swapped for another under its name";
  EXPECT_EQ(error_of([&] { sim.remove("relay"); }), refused);
  EXPECT_EQ(error_of([&] { sim.insert(instance("toy.relay_observe", "second"), "all"); }), refused);
  sim.swap("relay", instance("toy.relay_sense", "relay"));
  step(sim, 4);
  EXPECT_EQ(cell(sim, "instance/all/heard"), 7);
  EXPECT_EQ(cell(sim, "instance/all/heard", 3), 10'000'700);
}

TEST_F(Queues, BytesArriveExactlyAndTenMegabytesToo) {
  const std::string ends = "<toy.listen_network name='near'/>\n<toy.listen_control name='far'/>\n";
  Simulation sim =
      run(two_robots +
          "<toy.send_control name='s' robot='a' to='outbox/{robot}/message' size='10000000' every='2'/>\n" + ends);
  step(sim, 2);
  const Table& queue = *sim.table("outbox/*/message").table;
  ASSERT_EQ(queue.now().rows, 1u);
  const auto& bytes = *queue.now().blobs.at(0);
  ASSERT_EQ(bytes.size(), 10000004u);
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < 10000000; ++i) wrong += bytes[4 + i] != static_cast<uint8_t>(key_of("200") >> (i % 57));
  EXPECT_EQ(wrong, 0u);
  step(sim);
  EXPECT_EQ(cell(sim, "instance/near/heard", 1), 10000004);
  EXPECT_EQ(cell(sim, "instance/near/heard", 4), cell(sim, "instance/far/heard", 4));
  step(sim, 20);
  EXPECT_LE(queue.now().blobs.size(), 2u);
}

TEST_F(Queues, ARowNumberInARefusedAppendIsFound) {
  Simulation sim = run(two_robots + "<toy.send_control name='s' to='outbox/*/message' as='2'/>\n");
  EXPECT_EQ(error_of([&] { sim.step(); }),
            "3 world.xml:4:1: s (toy.send_control): step failed at tick 1 (t = 0.5 s): outbox/0/message: radio is no "
            "row of radio");
}

TEST_F(Queues, CellsOfAppendedRowsAreFilledAnewEachTime) {
  Simulation sim = run(two_robots + "<toy.lazy name='s' queue='true' at='3'/>\n");
  step(sim, 2);
  EXPECT_EQ(error_of([&] { sim.step(); }),
            "3 world.xml:4:1: s (toy.lazy): step failed at tick 3 (t = 1.5 s): outbox/1/message: radio is not filled; "
            "expected step() to fill each cell that it writes in every tick, also where nothing is to change");
}

}  // namespace
}  // namespace muster
