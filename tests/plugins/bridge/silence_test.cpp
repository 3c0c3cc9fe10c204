// Clients that are slow, leave, come back, or send what is no frame.
#include <gmock/gmock.h>

#include <future>
#include <random>
#include <thread>

#include "bridge/muster_client.hpp"
#include "tests/run_world.hpp"

namespace muster::test {
namespace {

using muster_client::Client;
using testing::HasSubstr;

// A world of one robot whose bridge listens in the folder.
class Bridged {
 public:
  explicit Bridged(const std::string& attributes)
      : run_(read_world(
                 folder_.write("world.xml", R"(<world name="w" dt="0.1" until="100"><robot name="r" at="0 0 0"/>)"
                                            R"(<bridge.socket name="driver" writes="robot/r/command outbox/r/message" )"
                                            R"(socket=")" +
                                                at() + "\" " + attributes + "/></world>"),
                 standard()),
             standard(), {{MUSTER_PLUGINS_DIR}, 1, {}}) {}
  std::string at() const { return folder_.at("s"); }
  Simulation& run() { return run_; }
  double v() const { return row<Command>(run_, "robot/r/command").v; }
  std::string events() const {
    std::string result;
    for (const auto& event : run_.events()) result += event.message + '\n';
    return result;
  }

 private:
  Folder folder_;
  Simulation run_;
};

void answer(Client& client, double v) { client.set("robot/r/command", {v, 0}); }

TEST(BridgeSilence, ASlowClientIsWaitedForOnceAndComesBackInStep) {
  Bridged world(R"(on_silence="hold" timeout="0.05" wait="60")");
  std::promise<void> go_on, is_sent;
  std::vector<uint64_t> seen;
  std::thread other([&] {
    Client client = muster_client::connect(world.at());
    while (client.next()) {
      seen.push_back(client.tick());
      if (client.tick() == 3) go_on.get_future().wait();
      answer(client, static_cast<double>(client.tick()));
      if (client.tick() != 3) continue;
      // The answer goes out with the next call of next(): this one waits in another thread's place.
      is_sent.set_value();
    }
  });
  auto& run = world.run();
  run.step(), run.step();
  EXPECT_EQ(world.v(), 2);
  run.step();  // waits for 0.05 s
  EXPECT_EQ(world.v(), 2);
  EXPECT_THAT(world.events(), HasSubstr("gave no answer within 0.05 s"));
  for (int i = 0; i < 200; ++i) run.step();  // 0.05 s each would be 10 s
  EXPECT_EQ(world.v(), 2);
  go_on.set_value();
  is_sent.get_future().wait();
  while (world.v() == 2) run.step();
  const uint64_t back = run.tick();
  EXPECT_EQ(world.v(), static_cast<double>(back));
  run.step();
  EXPECT_EQ(world.v(), static_cast<double>(back + 1));
  EXPECT_THAT(world.events(), HasSubstr("the client answers again"));
  run.close();
  other.join();
  EXPECT_THAT(seen, testing::ElementsAre(1, 2, 3, back, back + 1));
}

TEST(BridgeSilence, ASlowClientEndsTheRunWhereItIsRequired) {
  Bridged world(R"(timeout="0.02")");
  std::promise<void> is_over;
  std::thread other([&] {
    Client client = muster_client::connect(world.at());
    client.next();
    is_over.get_future().wait();
  });
  try {
    world.run().step();
    ADD_FAILURE() << "the run goes on without its client";
  } catch (const Error& e) {
    EXPECT_THAT(e.what(), HasSubstr("gave no answer within 0.02 s; on_silence=\"stop\" or \"hold\" would go on"));
  }
  is_over.set_value();
  other.join();
}

TEST(BridgeSilence, AnotherClientTakesOver) {
  Bridged world(R"(on_silence="stop")");
  auto& run = world.run();
  const auto drive = [&](double v, int ticks) {
    return std::thread([&world, v, ticks] {
      Client client = muster_client::connect(world.at());
      for (int i = 0; i < ticks && client.next(); ++i) answer(client, v);
      client.next();  // sends the last
    });
  };
  std::thread first = drive(7, 2);
  run.step(), run.step();
  EXPECT_EQ(world.v(), 7);
  // The first has seen a third tick, which it leaves without an answer.
  std::thread stepper([&] { run.step(); });
  first.join();
  stepper.join();
  EXPECT_EQ(world.v(), 0);
  EXPECT_THAT(world.events(), HasSubstr("has left"));
  std::thread second = drive(9, 1);
  while (world.v() == 0) run.step();
  EXPECT_EQ(world.v(), 9);
  EXPECT_THAT(world.events(), HasSubstr("a client is there again"));
  run.close();
  second.join();
}

TEST(BridgeNames, OfRowsInASetThatWasEmptyAtTheBeginningAreTold) {
  const Folder folder;
  const auto file = folder.write(
      "world.xml",
      R"(<world name="w" dt="0.1" until="100"><station name="base" at="0 0 1"/><physics.planar/><robots.drive/>)"
      R"(<robots.odometry/><bridge.socket reads="robot/*/odometry" writes="outbox/base/message" socket=")" +
          folder.at("s") + R"("/><at t="0.2"><robot name="late" at="0 0 0"/></at></world>)");
  Simulation run(read_world(file, standard()), standard(), {{MUSTER_PLUGINS_DIR}, 1, {}});
  std::size_t rows = 0;
  std::vector<std::string> names;
  std::thread other([&] {
    Client client = muster_client::connect(folder.at("s"));
    while (client.next()) {
      rows = client.rows("robot/*/odometry").size();
      try {
        names = client.names("robot");
      } catch (const std::out_of_range&) {  // none is known yet
      }
    }
  });
  for (int i = 0; i < 5; ++i) run.step();
  run.close();
  other.join();
  EXPECT_EQ(rows, 1u);
  EXPECT_THAT(names, testing::ElementsAre("late"));
}

// What the run says to a client that sends these bytes; its first frame is in order where `joins`.
std::string verdict(const std::string& bytes, bool joins = true) {
  Bridged world(R"(on_silence="hold" timeout="0.05" wait="60")");
  std::promise<void> is_over;
  std::thread other([&] {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    world.at().copy(address.sun_path, sizeof address.sun_path - 1);
    const int connection = ::socket(AF_UNIX, SOCK_STREAM, 0);
    while (::connect(connection, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    const std::string all = (joins ? std::string("\x09\0\0\0\x01MUSTERB1", 13) : "") + bytes;
    ::send(connection, all.data(), all.size(), MSG_NOSIGNAL);
    is_over.get_future().wait();
    ::close(connection);
  });
  std::string result;
  try {
    world.run().step();
  } catch (const Error& e) {
    result = e.what();
    EXPECT_EQ(e.exit(), Exit::invalid_input);
  }
  is_over.set_value();
  other.join();
  const auto at = result.find("the client sent ");
  return at == result.npos ? result : result.substr(at);
}

std::string frame(uint8_t kind, const std::string& body) {
  std::string result(4, '\0');
  const auto size = static_cast<uint32_t>(body.size() + 1);
  std::memcpy(result.data(), &size, 4);
  return result + static_cast<char>(kind) + body;
}

std::string word(uint64_t value, int bytes) {
  std::string result(reinterpret_cast<const char*>(&value), 8);
  return result.substr(0, static_cast<std::size_t>(bytes));
}
std::string real(double value) { return std::string(reinterpret_cast<const char*>(&value), 8); }

// COMMANDS of one row, and a queue without any.
std::string commands(uint64_t tick, double v, uint64_t rows = 1, const std::string& queue = word(0, 4)) {
  return frame(5, word(tick, 8) + word(rows, 4) + real(v) + real(0) + queue);
}

TEST(BridgeGarbage, EachFaultHasOneClearError) {
  EXPECT_EQ(verdict("GET / HTTP/1.1\r\n\r\n", false),
            "the client sent bytes that are no frame: 47 45 54 20 2f 20 48 54");
  EXPECT_EQ(verdict(std::string("\x09\0\0\0\x01MUSTERB7", 13), false),
            "the client sent a first frame that is no JOIN of MUSTERB1");
  EXPECT_EQ(verdict(std::string(8, '\0')), "the client sent bytes that are no frame: 00 00 00 00 00 00 00 00");
  EXPECT_EQ(verdict(frame(9, "")), "the client sent a frame of kind 9; expected COMMANDS");
  EXPECT_EQ(verdict(frame(5, "abc")), "the client sent a frame that ends 5 bytes too early");
  EXPECT_EQ(verdict(commands(2, 0)), "the client sent commands for tick 2; expected those for tick 1");
  EXPECT_EQ(verdict(commands(1, 0, 3)), "the client sent 3 rows of robot/r/command; expected 1");
  EXPECT_EQ(verdict(commands(1, std::nan(""))), "the client sent NaN as v[m/s] of robot/r/command; expected a number");
  EXPECT_EQ(verdict(commands(1, HUGE_VAL)),
            "the client sent an infinite number as v[m/s] of robot/r/command; expected a finite one");
  EXPECT_EQ(verdict(commands(1, 0, 1, word(0, 4) + "xy")), "the client sent 2 bytes too many in a frame of commands");
  EXPECT_EQ(verdict(commands(1, 0, 1, word(0xffffffff, 4))),
            "the client sent 4294967295 rows of outbox/r/message in a frame that ends before them");
  EXPECT_EQ(verdict(commands(1, 0, 1, word(1, 4) + real(0) + real(5) + real(0) + word(0, 4))),
            "the client sent the row outside of radio as to of outbox/r/message; expected a whole number below 1");
  EXPECT_EQ(verdict(commands(1, 0.5)), "") << "what is in order is taken";
}

TEST(BridgeGarbage, NoBytesHangOrCrashTheRun) {
  std::mt19937 random(7);
  const std::string good = commands(1, 0.5, 1, word(1, 4) + real(0) + real(0) + real(2) + word(2, 4) + "hi");
  int refused = 0;
  for (int i = 0; i < 60; ++i) {
    std::string bytes = good;
    for (int change = 0; change < 3; ++change) bytes[random() % bytes.size()] = static_cast<char>(random());
    if (i % 3 == 0) bytes.resize(random() % bytes.size());
    const std::string said = verdict(bytes);
    EXPECT_TRUE(said.empty() || said.rfind("the client sent ", 0) == 0) << said;
    refused += !said.empty();
  }
  EXPECT_GT(refused, 10);
}

}  // namespace
}  // namespace muster::test
