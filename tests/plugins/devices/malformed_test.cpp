// Datagrams that are none: random bytes, and true ones with bytes changed, cut off or added. Both ends count them, take
// nothing of them, and go on.
#include <gtest/gtest.h>

#include <deque>

#include "plugins/devices/link.hpp"

namespace muster::devices {
namespace {

struct Given : Wire {
  void send(const Address&, const std::string& bytes) override { sent.push_back(bytes); }
  bool receive(Address& from, std::string& bytes) override {
    if (coming.empty()) return false;
    from = sender;
    bytes = coming.front();
    coming.pop_front();
    return true;
  }
  Address sender{1, 1};
  std::deque<std::string> coming;
  std::vector<std::string> sent;
};

const std::vector<TableShape> exchanged{{"robot/{robot}/odometry", "x[m] y[m]", true},
                                        {"robot/{robot}/command", "v[m/s] w[rad/s]", false}};

std::string datagram(ports::Kind kind, std::uint64_t session, std::uint64_t sequence, const std::string& body = "") {
  ports::FrameWriter frame = begun_datagram(kind, {session, sequence, 0, 1.5});
  frame.raw(body);
  return frame.take();
}

std::string asking(std::uint64_t session) {
  ports::FrameWriter frame = begun_datagram(ports::Kind::join, {session, 1, 0, 0});
  write_tables(frame, exchanged);
  return frame.take();
}

// Changed at random, and so that it is never what it was.
std::string spoilt(std::string bytes, const Stream& random, std::uint64_t which) {
  const auto draw = [&](std::uint64_t what, std::size_t below) {
    return std::min(below - 1, static_cast<std::size_t>(random.uniform(which, what) * static_cast<double>(below)));
  };
  const std::string before = bytes;
  switch (draw(0, 4)) {
    case 0:
      bytes.resize(draw(1, bytes.size()));
      break;
    case 1:
      bytes += std::string(1 + draw(1, 40), static_cast<char>(draw(2, 256)));
      break;
    case 2:  // a byte of the length, the kind or the magic word
      bytes[draw(1, 13)] ^= static_cast<char>(1 + draw(2, 255));
      break;
    default:
      for (auto& byte : bytes)
        byte = static_cast<char>(draw(3 + static_cast<std::uint64_t>(&byte - bytes.data()), 256));
  }
  return bytes == before ? bytes + '!' : bytes;
}

TEST(MalformedDatagrams, AreCountedAndMoveNothing) {
  const Stream random(42);
  Given wire;
  RobotEnd robot(wire, exchanged, 5);
  int taken = 0;
  const auto take = [&](std::string_view) { ++taken; };
  wire.coming.push_back(asking(9));
  robot.receive(0, 0.5, take);
  ASSERT_TRUE(robot.has_controller());
  constexpr std::uint64_t many = 20'000;
  std::uint64_t changed_kind = 0;
  for (std::uint64_t i = 0; i < many; ++i) {
    const std::string wrong = spoilt(datagram(ports::Kind::commands, 9, 2 + i, "rows"), random, i);
    // A kind that became another valid one is refused for its content, or is a farewell.
    try {
      if (const auto kind = parsed_datagram(wrong).kind; kind == ports::Kind::bye) continue;
      ++changed_kind;
    } catch (const ports::Malformed&) {
    }
    wire.coming.push_back(wrong);
    robot.receive(1, 0.5, take);
  }
  EXPECT_EQ(taken, 0);
  EXPECT_TRUE(robot.has_controller());
  EXPECT_GT(robot.refused().malformed, many * 9 / 10);
  EXPECT_LT(changed_kind, many / 10);
  wire.coming.push_back(datagram(ports::Kind::commands, 9, 5 * many, "rows"));
  robot.receive(2, 0.5, take);
  EXPECT_EQ(taken, 1) << "a true one is taken still";
}

TEST(MalformedDatagrams, AreCountedByAControllerToo) {
  const Stream random(43);
  Given wire;
  ControllerEnd controller(wire, wire.sender, exchanged, 9);
  int taken = 0;
  const auto take = [&](std::string_view) { ++taken; };
  ports::FrameWriter agreed = begun_datagram(ports::Kind::tables, {5, 1, 0, 0});
  write_tables(agreed, exchanged);
  wire.coming.push_back(agreed.take());
  controller.receive(0, take);
  ASSERT_TRUE(controller.has_agreed());
  constexpr std::uint64_t many = 20'000;
  for (std::uint64_t i = 0; i < many; ++i) {
    const std::string wrong = spoilt(datagram(ports::Kind::state, 5, 2 + i, "rows"), random, i);
    try {
      const auto kind = parsed_datagram(wrong).kind;
      if (kind == ports::Kind::bye || kind == ports::Kind::fault) continue;  // true ones of another meaning
    } catch (const ports::Malformed&) {
    }
    wire.coming.push_back(wrong);
    controller.receive(1, take);
  }
  EXPECT_EQ(taken, 0);
  EXPECT_TRUE(controller.has_agreed());
  EXPECT_GT(controller.refused().malformed, many * 9 / 10);
  wire.sender = {1, 2};
  wire.coming.push_back(datagram(ports::Kind::state, 5, 5 * many, "rows"));
  controller.receive(2, take);
  EXPECT_EQ(taken, 0);
  EXPECT_EQ(controller.refused().foreign, 1u) << "from another address";
}

// Lists of tables with bytes at random in them: no list is taken for another, and nothing of them is printed.
TEST(MalformedDatagrams, ListsOfTablesThatAreNoneMoveNothing) {
  const Stream random(44);
  Given wire;
  RobotEnd robot(wire, exchanged, 5);
  wire.coming.push_back(asking(9));
  robot.receive(0, 0.5, [](std::string_view) {});
  ASSERT_TRUE(robot.has_controller());
  const std::string whole = asking(9);
  constexpr std::size_t stamp = 45;  // length, kind and stamp
  for (std::uint64_t i = 0; i < 20'000; ++i) {
    std::string wrong = whole;
    const auto at = stamp + static_cast<std::size_t>(random.uniform(i, 0) * static_cast<double>(whole.size() - stamp));
    wrong[at] = static_cast<char>(wrong[at] ^ static_cast<char>(1 + random.uniform(i, 1) * 255));
    wire.coming.push_back(wrong);
    robot.receive(1, 0.5, [](std::string_view) {});
    for (const char c : robot.disagreement()) ASSERT_TRUE(c >= ' ' && c <= '~') << i;
    ASSERT_LE(robot.disagreement().size(), 5000u);
  }
  EXPECT_EQ(robot.refused().malformed + robot.refused().foreign, 20'000u) << "each is one or the other";
  EXPECT_TRUE(robot.has_controller()) << "the first one still drives";
  EXPECT_EQ(robot.from_controller().session(), 9u);
}

// Somebody who sends faster than they are read.
struct Flood : Wire {
  void send(const Address&, const std::string&) override {}
  bool receive(Address& from, std::string& bytes) override {
    from = {1, 1};
    bytes = "none";
    return ++read < 5 * most_at_once;
  }
  std::size_t read = 0;
};

TEST(MalformedDatagrams, ThatComeOnAndOnLetATickEnd) {
  const auto nothing = [](std::string_view) {};
  Flood at_controller, at_robot, at_rough;
  ControllerEnd controller(at_controller, {1, 1}, exchanged, 9);
  RobotEnd robot(at_robot, exchanged, 5);
  RoughWire rough(at_rough, {1, 0, 0}, Stream(1));  // loses all
  Address from;
  std::string bytes;
  for (std::size_t tick = 1; tick <= 2; ++tick) {
    controller.receive(0, nothing);
    EXPECT_EQ(controller.refused().malformed, tick * most_at_once);
    robot.receive(0, 0.5, nothing);
    EXPECT_EQ(robot.refused().malformed, tick * most_at_once);
    rough.at(0);
    for (int i = 0; i < 3; ++i) EXPECT_FALSE(rough.receive(from, bytes));
    EXPECT_EQ(at_rough.read, tick * most_at_once);
  }
}

// Rows that are none are refused by whoever takes them: the datagram is counted, and nothing is heard.
TEST(MalformedDatagrams, RowsThatAreNoneCountToo) {
  Given wire;
  RobotEnd robot(wire, exchanged, 5);
  wire.coming = {asking(9), datagram(ports::Kind::commands, 9, 2, "rows")};
  robot.receive(0, 0.5, [](std::string_view) { throw ports::Malformed("no rows"); });
  EXPECT_EQ(robot.refused().malformed, 1u);
  EXPECT_FALSE(robot.has_heard());
}

}  // namespace
}  // namespace muster::devices
