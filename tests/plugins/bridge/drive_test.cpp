// The same controller in process and over the bridge, from Python and from C++: the same run to the last bit.
#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include "process.hpp"
#include "tests/cli/errors/program.hpp"

namespace muster::test {
namespace {

using testing::HasSubstr;

const std::string tables = R"(reads="robot/east/odometry inbox/east/message robot/west/odometry inbox/west/message" )"
                           R"(writes="robot/east/command outbox/east/message robot/west/command outbox/west/message")";

std::string world(const std::string& controller) {
  return R"(<world name="pair" dt="0.05" until="5" seed="3"><station name="base" at="1 1 1"/>
  <robot name="east" at="3 0 0"/><robot name="west" at="-3 0 0" heading="2"/>
  <robots.drive/><radio.multiwall l0="40" n="2"/><radio.fading shadowing="3"/><network.ideal/>
  <control.beacon radio="base"/>)" +
         controller + R"(<record table="robot/*/command"/></world>)";
}

std::string digest_of(const Outcome& outcome) {
  EXPECT_EQ(outcome.exit, 0) << outcome.err;
  const auto at = outcome.out.find("\"digest\": \"");
  return at == std::string::npos ? outcome.err : outcome.out.substr(at, 28);
}

uint16_t free_port() {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  const int probe = ::socket(AF_INET, SOCK_STREAM, 0);
  EXPECT_EQ(::bind(probe, reinterpret_cast<sockaddr*>(&address), size), 0);
  ::getsockname(probe, reinterpret_cast<sockaddr*>(&address), &size);
  ::close(probe);
  return ntohs(address.sin_port);
}

std::vector<std::string> python(const std::string& at) {
  return {"python3", MUSTER_BRIDGE_TESTS "/clients/pair.py", MUSTER_SOURCE_DIR "/bridge", at};
}

struct Driven {
  Outcome outcome;
  int client = -1;
  std::string commands;
};

class Bridge : public testing::Test {
 protected:
  Driven run(const std::string& attributes, const std::vector<std::string>& client) const {
    folder.write("world.xml", world("<bridge.socket name=\"driver\" " + attributes + ' ' + tables + "/>"));
    ClientProcess process(client);
    Driven result;
    result.outcome = folder.muster({"run", "world.xml", "--json", "--out", "out", "--plugins", MUSTER_TOYS_DIR});
    result.client = process.exit();
    result.commands = folder.read("out/robot_command.csv");
    return result;
  }
  Driven in_process() const {
    folder.write("world.xml", world("<test.pair name=\"driver\"/>"));
    Driven result;
    result.outcome = folder.muster({"run", "world.xml", "--json", "--out", "out", "--plugins", MUSTER_TOYS_DIR});
    result.commands = folder.read("out/robot_command.csv");
    return result;
  }
  std::string at() const { return folder.at("s"); }
  std::string socket() const { return "socket=\"" + at() + '"'; }
  ProgramFolder folder;
};

TEST_F(Bridge, AClientOfPythonDrivesAsAPluginDoesToTheBit) {
  const Driven own = in_process(), bridged = run(socket(), python(at()));
  EXPECT_EQ(digest_of(bridged.outcome), digest_of(own.outcome));
  EXPECT_EQ(bridged.commands, own.commands);
  EXPECT_EQ(bridged.client, 0);
  EXPECT_THAT(bridged.outcome.err, HasSubstr("bridge.socket listens at " + at() + " and waits 60 s for a client\n"));
  EXPECT_GT(std::count(own.commands.begin(), own.commands.end(), '\n'), 200);  // 100 ticks of two robots
}

TEST_F(Bridge, SoDoesAClientOfCppOverTcp) {
  const std::string port = std::to_string(free_port());
  const Driven own = in_process(), bridged = run("port=\"" + port + '"', {MUSTER_PAIR_CLIENT, port});
  EXPECT_EQ(digest_of(bridged.outcome), digest_of(own.outcome));
  EXPECT_EQ(bridged.client, 0);
  EXPECT_THAT(bridged.outcome.err, HasSubstr("listens at 127.0.0.1:" + port));
}

std::string commands_at(const std::string& csv, const std::string& time) {
  std::string result;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind(time + ',', 0) == 0) result += line.substr(time.size()) + '\n';
  }
  return result;
}

TEST_F(Bridge, AKilledClientEndsTheRunWithItsName) {
  auto client = python(at());
  client.push_back("21");
  const Driven killed = run(socket(), client);
  EXPECT_EQ(killed.client, 128 + 9);
  EXPECT_EQ(killed.outcome.exit, 2);
  EXPECT_THAT(killed.outcome.err,
              HasSubstr("driver (bridge.socket): step failed at tick 21 (t = 1.05 s): the client at " + at() +
                        " has left; on_silence=\"stop\" or \"hold\" would go on without it"));
  const std::string before = commands_at(in_process().commands, "1");
  EXPECT_THAT(before, HasSubstr(",east,0."));
  EXPECT_EQ(commands_at(killed.commands, "1"), before);
}

TEST_F(Bridge, AfterAKilledClientRobotsStop) {
  auto client = python(at());
  client.push_back("21");
  const Driven stopped = run(socket() + " on_silence=\"stop\"", client);
  EXPECT_EQ(stopped.outcome.exit, 0) << stopped.outcome.err;
  EXPECT_THAT(stopped.outcome.out, HasSubstr("the client at " + at() + " has left"));
  for (const char* time : {"1.25", "5"}) EXPECT_EQ(commands_at(stopped.commands, time), ",east,0,0\n,west,0,0\n");
}

TEST_F(Bridge, OrGoOnAsTheyWereCommandedLast) {
  auto client = python(at());
  client.push_back("21");
  const Driven held = run(socket() + " on_silence=\"hold\"", client);
  EXPECT_EQ(held.outcome.exit, 0) << held.outcome.err;
  const std::string last = commands_at(held.commands, "1");
  EXPECT_THAT(last, HasSubstr(",east,0."));
  for (const char* time : {"1.25", "5"}) EXPECT_EQ(commands_at(held.commands, time), last);
}

TEST_F(Bridge, WhereNobodyComesTheRunEnds) {
  folder.write("world.xml", world("<bridge.socket name=\"driver\" wait=\"0.05\" " + socket() + ' ' + tables + "/>"));
  const auto outcome = folder.muster({"run", "world.xml"});
  EXPECT_EQ(outcome.exit, 2);
  EXPECT_THAT(outcome.err,
              HasSubstr("no client came to " + at() + " within 0.05 s; expected one to be started, or a longer wait"));
  EXPECT_FALSE(std::filesystem::exists(at())) << "the socket's file stays";
}

TEST_F(Bridge, ACheckWaitsForNobody) {
  folder.write("world.xml", world("<bridge.socket name=\"driver\" " + socket() + ' ' + tables + "/>"));
  const auto outcome = folder.muster({"check", "world.xml"});
  EXPECT_EQ(outcome.exit, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_FALSE(std::filesystem::exists(at()));
}

}  // namespace
}  // namespace muster::test
