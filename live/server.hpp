// A server for one address of this computer: requests of HTTP and websockets, by Boost.Beast. It runs in the caller's
// thread: what comes is answered while serve() lasts, no request can stop it, and nobody who reads slowly can hold it
// up.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace muster::live {

struct HttpRequest {
  std::string method, path, body;
  std::map<std::string, std::string> query, headers;  // headers in lower case
};

struct HttpResponse {
  int status = 200;
  std::string type = "text/plain; charset=utf-8", body{};
};

// May be called later, between two calls of serve() or in one; without a call the connection is closed.
using Reply = std::function<void(HttpResponse)>;

// What is sent over a websocket: two parts, of which clients may share the second.
struct Frame {
  std::string head;
  std::shared_ptr<const std::string> body{};
  bool is_binary = false;
  bool may_drop = false;  // where the client reads too slowly

  std::size_t size() const { return head.size() + (body ? body->size() : 0); }
};

// The other end of a websocket. What waits for it is bounded: then the oldest frames that may be dropped are, and a
// client that leaves too many others unread is disconnected.
class Client {
 public:
  virtual ~Client() = default;
  virtual void send(Frame frame) = 0;
};

// Bytes that may wait for one client.
inline constexpr std::size_t most_waiting = 16 * 1024 * 1024;

class Listener {
 public:
  virtual ~Listener() = default;
  virtual void opened(Client& client) = 0;
  virtual void received(Client& client, std::string_view message, bool is_binary) = 0;
  // It reads again, after so many frames were dropped.
  virtual void caught_up(Client& client, std::uint64_t dropped) = 0;
  // Never from within send().
  virtual void closed(Client& client) = 0;
};

class Server {
 public:
  struct Rules {
    // An answer for what is not allowed here, websockets included.
    std::function<std::optional<HttpResponse>(const HttpRequest&)> refusal;
    std::function<void(const HttpRequest&, Reply)> handler;
    std::vector<std::string> subprotocols;  // of websockets; a client must offer one of them
  };
  // Port 0: one that is free. Throws Error.
  Server(const std::string& address, std::uint16_t port, Rules rules, Listener& listener);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  std::uint16_t port() const;
  // Answers what comes within so many seconds, or until wake(); 0: what is there already, for some milliseconds at
  // most.
  void serve(double seconds);
  // Ends the serve() that is under way, after the request that it answers.
  void wake();
  // Says goodbye to clients; returns when they have what was sent to them, or none has read anything for so long.
  void close(double patience);

 private:
  class Inside;
  std::unique_ptr<Inside> inside_;
};

}  // namespace muster::live
