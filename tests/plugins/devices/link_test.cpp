// The laws of the conversation, without a socket and without a clock: each end is told the time.
#include "plugins/devices/link.hpp"

#include <gmock/gmock.h>

#include <deque>

#include "plugins/devices/pace.hpp"

namespace muster::devices {
namespace {

using ports::Kind;

// Both ends in one process: what one sends lies in the other's queue until it is taken.
struct Ether {
  struct One : Wire {
    One(Ether& in, const Address& own) : ether(in), at(own) {}
    void send(const Address& to, const std::string& bytes) override { ether.queues[to.port].push_back({at, bytes}); }
    bool receive(Address& from, std::string& bytes) override {
      auto& queue = ether.queues[at.port];
      if (queue.empty()) return false;
      from = queue.front().first;
      bytes = queue.front().second;
      queue.pop_front();
      return true;
    }
    Ether& ether;
    Address at;
  };
  std::map<std::uint16_t, std::deque<std::pair<Address, std::string>>> queues;
};

const Address here{0x7f000001, 1}, there{0x7f000001, 2}, third{0x7f000001, 3};
const std::vector<TableShape> tables{{"robot/{robot}/odometry", "x[m] y[m]", true},
                                     {"robot/{robot}/command", "v[m/s] w[rad/s]", false}};

struct Pair : testing::Test {
  Ether ether;
  Ether::One controllers{ether, here}, robots{ether, there};
  ControllerEnd controller{controllers, there, tables, 100};
  RobotEnd robot{robots, tables, 200};
  std::vector<std::string> states, commands;

  void controller_takes(double now) {
    controller.receive(now, [&](std::string_view body) { states.emplace_back(body); });
  }
  void robot_takes(double now, double watchdog = 0.5) {
    robot.receive(now, watchdog, [&](std::string_view body) { commands.emplace_back(body); });
  }
  void agree(double now = 0) {
    controller.ask(now);
    robot_takes(now);
    controller_takes(now);
  }
};

TEST_F(Pair, NothingIsSentBeforeBothAgree) {
  controller.command(0, "go");
  robot.tell(0, "here");
  EXPECT_TRUE(ether.queues[1].empty());
  EXPECT_TRUE(ether.queues[2].empty());
  agree();
  EXPECT_TRUE(controller.has_agreed());
  EXPECT_TRUE(robot.has_controller());
  EXPECT_FALSE(controller.has_heard());
  EXPECT_FALSE(robot.has_heard());
}

TEST_F(Pair, CommandsAndStatesComeOnceInTheirOrder) {
  agree();
  for (int i = 0; i < 5; ++i) {
    controller.command(0.1 * i, "go " + std::to_string(i));
    robot.tell(0.1 * i, "here " + std::to_string(i));
  }
  robot_takes(0.7);
  controller_takes(0.8);
  EXPECT_THAT(commands, testing::ElementsAre("go 0", "go 1", "go 2", "go 3", "go 4"));
  EXPECT_THAT(states, testing::ElementsAre("here 0", "here 1", "here 2", "here 3", "here 4"));
  EXPECT_EQ(robot.heard(), 0.7);
  EXPECT_EQ(controller.heard(), 0.8);
  EXPECT_EQ(controller.from_robot().counts().lost, 0u);
}

TEST_F(Pair, ARoundTripIsFromTheCommandToTheStateThatHasHadIt) {
  agree();
  controller.command(1.0, "go");
  robot_takes(1.25);
  robot.tell(1.25, "here");
  controller_takes(1.5);
  EXPECT_EQ(controller.round_trip(), 0.5);
}

// Datagrams of the robot in any order, some twice, some never: each is counted as what it is.
TEST_F(Pair, LostLateAndDoubleOnesAreCountedExactly) {
  agree();
  for (int i = 0; i < 10; ++i) robot.tell(i, std::to_string(i));
  auto& queue = ether.queues[1];
  const auto all = queue;
  queue = {all[0], all[1], all[1], all[4], all[2], all[2], all[5], all[9], all[0]};
  controller_takes(10);
  EXPECT_THAT(states, testing::ElementsAre("0", "1", "4", "5", "9"));
  const auto& counts = controller.from_robot().counts();
  EXPECT_EQ(counts.received, 5u + 1u) << "and the tables";
  EXPECT_EQ(counts.late, 1u) << "2";
  EXPECT_EQ(counts.duplicate, 3u) << "1, 2 and 0";
  EXPECT_EQ(counts.lost, 4u) << "3, 6, 7 and 8";
}

TEST(Sequences, ALateOneFarBehindIsNoGain) {
  Sequence sequence;
  sequence.restart(1);
  EXPECT_EQ(sequence.take(1), Sequence::Taken::fresh);
  EXPECT_EQ(sequence.take(1000), Sequence::Taken::fresh);
  EXPECT_EQ(sequence.counts().lost, 998u);
  EXPECT_EQ(sequence.take(999), Sequence::Taken::late);
  EXPECT_EQ(sequence.counts().lost, 997u);
  EXPECT_EQ(sequence.take(999), Sequence::Taken::duplicate);
  EXPECT_EQ(sequence.take(3), Sequence::Taken::late);
  EXPECT_EQ(sequence.counts().lost, 997u) << "whether that one had come is not known any more";
  sequence.restart(2);
  EXPECT_EQ(sequence.take(7), Sequence::Taken::fresh) << "a session may begin anywhere";
  EXPECT_EQ(sequence.counts().lost, 997u);
}

TEST_F(Pair, AnotherControllerIsRefusedUntilTheFirstIsSilent) {
  agree(0);
  Ether::One others(ether, third);
  ControllerEnd other(others, there, tables, 50);
  const auto nothing = [](std::string_view) {};
  other.ask(0.4);
  robot_takes(0.4);
  try {
    other.receive(0.4, nothing);
    ADD_FAILURE() << "it was not refused";
  } catch (const BadInput& refused) {
    EXPECT_STREQ(refused.what(), "the robot at 127.0.0.1:2 refuses: it is driven by 127.0.0.1:1 already");
  }
  other.ask(0.6);
  robot_takes(0.6);
  other.receive(0.6, nothing);
  EXPECT_TRUE(other.has_agreed());
  EXPECT_EQ(robot.controller(), third);
  controller.command(0.7, "go");
  robot_takes(0.7);
  EXPECT_THAT(commands, testing::IsEmpty()) << "the first one drives no more";
}

TEST_F(Pair, ARobotThatStartsAnewIsAskedAnew) {
  agree();
  RobotEnd again(robots, tables, 300);
  const auto nothing = [](std::string_view) {};
  robot.tell(1, "old");
  controller_takes(1);
  controller.ask(2);
  again.receive(2, 0.5, nothing);
  again.tell(2, "new");
  controller_takes(2);
  robot.tell(2, "from the one that has ended");
  controller_takes(3);
  EXPECT_THAT(states, testing::ElementsAre("old", "new"));
  EXPECT_EQ(controller.refused().foreign, 1u);
}

TEST_F(Pair, AFarewellEndsIt) {
  agree();
  controller.command(1, "go");
  controller.say_bye(1);
  robot_takes(1);
  EXPECT_FALSE(robot.has_controller());
  EXPECT_FALSE(robot.has_heard());
  robot.tell(1, "here");
  EXPECT_TRUE(ether.queues[1].empty());
}

TEST_F(Pair, TablesThatAreOthersAreNamed) {
  const auto told = [](const std::vector<TableShape>& ours, const std::vector<TableShape>& theirs) {
    return disagreement(ours, theirs, "the robot");
  };
  EXPECT_EQ(told(tables, tables), "");
  EXPECT_EQ(told(tables, {tables[1]}), "the robot gives no robot/{robot}/odometry; expected one of none");
  EXPECT_EQ(told(tables, {tables[0]}), "the robot takes no robot/{robot}/command; expected one of none");
  EXPECT_EQ(told({tables[0]}, tables),
            "the robot takes robot/{robot}/command, which this end does not exchange; expected the same tables at both "
            "ends");
  EXPECT_EQ(told(tables, {{tables[0].name, "x[m]", true}, tables[1]}),
            "the robot has robot/{robot}/odometry with the columns \"x[m]\"; expected \"x[m] y[m]\"");
  RobotEnd other(robots, {tables[1]}, 9);
  controller.ask(0);
  other.receive(0, 0.5, [](std::string_view) {});
  EXPECT_FALSE(other.has_controller());
  EXPECT_THROW(controller_takes(0), BadInput);
}

// Time as a test has it.
struct Told : Clock {
  double now() override { return at; }
  void sleep(double seconds) override { at += seconds; }
  double at = 100;
};

TEST(DevicePace, ATickEndsAtItsMomentAndALateRunCatchesUpUnlessItIsTooLate) {
  Told clock;
  Pace pace(clock);
  EXPECT_EQ(pace.wait(0, 2, 0.5), 0);
  EXPECT_EQ(clock.at, 100);
  EXPECT_EQ(pace.wait(1, 2, 0.5), 0);
  EXPECT_EQ(clock.at, 100.5) << "twice as fast as the clock";
  clock.at += 0.25;  // a little late: no waiting until that is made up
  EXPECT_EQ(pace.wait(1.25, 2, 0.5), 0);
  EXPECT_EQ(clock.at, 100.75);
  EXPECT_EQ(pace.wait(2, 2, 0.5), 0);
  EXPECT_EQ(clock.at, 101);
  clock.at += 10;
  EXPECT_EQ(pace.wait(2.5, 2, 0.5), 9.75) << "the run goes on from there";
  EXPECT_EQ(pace.wait(3.5, 2, 0.5), 0);
  EXPECT_EQ(clock.at, 111.5);
  EXPECT_EQ(pace.wait(4.5, 0.5, 0.5), 0);
  EXPECT_EQ(clock.at, 113.5) << "slower from now on";
}

// Each datagram goes its own way, drawn from the seed: shares and delays are those that were asked for.
TEST(RoughWires, LoseAndDelayAsTheyAreTold) {
  Ether ether;
  Ether::One plain(ether, here);
  RoughWire wire(plain, {0.25, 0.1, 0.2}, Stream(7));
  constexpr int many = 4000;
  for (int i = 0; i < many; ++i) {
    wire.at(0);
    wire.send(there, std::to_string(i));
  }
  EXPECT_TRUE(ether.queues[2].empty());
  wire.at(0.0999);
  EXPECT_TRUE(ether.queues[2].empty()) << "none is earlier than the delay";
  wire.at(0.2);
  const auto half = ether.queues[2].size();
  wire.at(0.3);
  const auto all = ether.queues[2].size();
  const double share = 0.75 * many, deviation = std::sqrt(0.75 * 0.25 * many);
  EXPECT_NEAR(static_cast<double>(all), share, 5 * deviation);
  EXPECT_NEAR(static_cast<double>(half), share / 2, 5 * std::sqrt(0.375 * 0.625 * many));
  bool is_in_order = true;
  for (std::size_t i = 1; i < all; ++i)
    is_in_order = is_in_order && ether.queues[2][i].second.size() >= ether.queues[2][i - 1].second.size();
  EXPECT_FALSE(is_in_order) << "jitter lets them overtake one another";
}

}  // namespace
}  // namespace muster::devices
