// Clients that read too slowly: what of theirs may be left out, and when the listener is told that one is lost.
#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "live/foxglove.hpp"
#include "live/server.hpp"
#include "mcap/rewrite.hpp"

namespace muster::live {
namespace {

struct Reader : Client {
  std::vector<Frame> frames;
  void send(Frame frame) override { frames.push_back(std::move(frame)); }
};

TEST(Clients, OfTheLastTickAllMayBeLeftOutButTheScene) {
  Foxglove foxglove({"run", [] { return std::map<std::string, std::string>(); },
                     [] { return std::vector<Foxglove::Parameter>(); }, [](const std::string&, double) {}});
  const auto schema = foxglove.schema({0, "text", "ros2msg", "string text"});
  const auto moves = foxglove.channel({0, schema, "/camera", "cdr"});
  const auto scene = foxglove.channel({0, schema, "/scene", "cdr", {{mcap::still, "true"}}});
  foxglove.begin(0);
  foxglove.message({moves, 0, 0, 0, "an image"});
  foxglove.message({scene, 0, 0, 0, "walls"});
  Reader reader;
  foxglove.opened(reader);
  foxglove.received(reader,
                    "{\"op\":\"subscribe\",\"subscriptions\":[{\"id\":1,\"channelId\":" + std::to_string(moves) +
                        "},{\"id\":2,\"channelId\":" + std::to_string(scene) + "}]}",
                    false);
  std::vector<std::pair<std::string, bool>> kept;
  for (const Frame& frame : reader.frames) {
    if (frame.body) kept.emplace_back(*frame.body, frame.may_drop);
  }
  EXPECT_THAT(kept, testing::ElementsAre(std::pair("an image", true), std::pair("walls", false)));
}

// Answers a word with more than may wait for a client.
struct Flood : Listener {
  int opens = 0, closes = 0;
  bool is_sending = false, is_told_while_sending = false;

  void opened(Client&) override { ++opens; }
  void received(Client& client, std::string_view, bool) override {
    is_sending = true;
    const auto body = std::make_shared<const std::string>(most_waiting / 2 + 1, 'x');
    for (int i = 0; i < 3; ++i) client.send({"", body, true, false});
    is_sending = false;
  }
  void caught_up(Client&, std::uint64_t) override {}
  void closed(Client&) override {
    ++closes;
    is_told_while_sending |= is_sending;
  }
};

// The other end of a connection, which reads nothing.
class Deaf {
 public:
  explicit Deaf(std::uint16_t port) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(port);
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(::connect(socket_, reinterpret_cast<const sockaddr*>(&to), sizeof to), 0);
  }
  ~Deaf() { ::close(socket_); }
  Deaf(const Deaf&) = delete;
  Deaf& operator=(const Deaf&) = delete;

  void say(const std::string& bytes) const {
    EXPECT_EQ(::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL), static_cast<ssize_t>(bytes.size()));
  }

 private:
  int socket_;
};

TEST(Clients, OneThatIsLostIsForgottenAfterWhatIsBeingSent) {
  Flood flood;
  Server server("127.0.0.1", 0,
                {[](const HttpRequest&) { return std::optional<HttpResponse>(); },
                 [](const HttpRequest&, const Reply&) {},
                 {"words"}},
                flood);
  const auto serve_until = [&](const int& count) {
    for (int i = 0; i < 2000 && count == 0; ++i) server.serve(0.005);
    return count;
  };
  const Deaf client(server.port());
  client.say(
      "GET / HTTP/1.1\r\nHost: 127.0.0.1\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
      "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Protocol: words\r\n\r\n");
  ASSERT_EQ(serve_until(flood.opens), 1);
  client.say(std::string("\x81\x81\0\0\0\0x", 7));  // a text of one letter, with a mask of zeros
  EXPECT_EQ(serve_until(flood.closes), 1);
  EXPECT_FALSE(flood.is_told_while_sending);
}

}  // namespace
}  // namespace muster::live
