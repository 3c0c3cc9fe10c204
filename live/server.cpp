#include "live/server.hpp"

#include <algorithm>
#include <chrono>
#include <list>
#include <sstream>
#include <utility>

#include "live/websocket.hpp"
#include "text/error.hpp"
#include "text/text_file.hpp"

namespace muster::live {
namespace {

namespace beast = boost::beast;
namespace http = beast::http;
namespace asio = boost::asio;
using tcp = asio::ip::tcp;

constexpr std::size_t most_head = 16384;          // bytes of a request
constexpr std::uint64_t most_body = 1024 * 1024;  // bytes
constexpr std::size_t most_left = 64 << 20;       // bytes that may follow a refusal
constexpr std::size_t most_connections = 32;      // a browser opens six
constexpr std::size_t most_clients = 16;          // of websockets
constexpr auto request_time = std::chrono::seconds(30);
constexpr auto at_once = std::chrono::milliseconds(5);  // that serve(0) may last

std::map<std::string, std::string> parsed_query(const std::string& text) {
  std::map<std::string, std::string> result;
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, '&');) {
    const auto equals = std::min(part.find('='), part.size());
    result[part.substr(0, equals)] = equals < part.size() ? part.substr(equals + 1) : "";
  }
  return result;
}

std::string lower(beast::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c; });
  return result;
}

HttpRequest read_request(const http::request<http::string_body>& from) {
  HttpRequest request;
  const std::string target(from.target());
  const auto mark = std::min(target.find('?'), target.size());
  request.method = std::string(from.method_string());
  request.path = target.substr(0, mark);
  if (mark < target.size()) request.query = parsed_query(target.substr(mark + 1));
  for (const auto& field : from) request.headers[lower(field.name_string())] = std::string(field.value());
  request.body = from.body();
  return request;
}

using TakeSocket = std::function<bool(beast::tcp_stream&, WebSocket::Request, const HttpRequest&)>;

// One request and its answer; or the request of a websocket, whose connection is then handed on.
class Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(tcp::socket socket, const Server::Rules& rules, TakeSocket take_socket)
      : stream_(std::move(socket)), rules_(rules), take_socket_(std::move(take_socket)) {
    parser_.header_limit(static_cast<std::uint32_t>(most_head));
    parser_.body_limit(most_body);
  }

  void read() {
    stream_.expires_after(request_time);
    http::async_read(stream_, in_, parser_,
                     [self = shared_from_this()](beast::error_code error, std::size_t) { self->take(error); });
  }
  void close() {
    beast::error_code ignored;
    stream_.socket().close(ignored);
  }

 private:
  void take(beast::error_code error) {
    if (error == http::error::end_of_stream || error == beast::error::timeout) return;
    if (error == http::error::body_limit) return answer({413, "text/plain; charset=utf-8", "too long\n"});
    if (error && error.category() != make_error_code(http::error::bad_method).category()) return;
    if (error || parser_.get().target().empty() || parser_.get().target()[0] != '/')
      return answer({400, "text/plain; charset=utf-8", "no request of HTTP\n"});
    const HttpRequest request = read_request(parser_.get());
    if (auto refused = rules_.refusal(request)) return answer(std::move(*refused));
    if (beast::websocket::is_upgrade(parser_.get())) {
      if (!take_socket_(stream_, parser_.release(), request))
        answer({400, "text/plain; charset=utf-8", "expected a websocket of " + rules_.subprotocols.front() + '\n'});
      return;
    }
    rules_.handler(request, [self = shared_from_this()](HttpResponse response) { self->answer(std::move(response)); });
  }

  void answer(HttpResponse response) {
    answer_.version(11);
    answer_.result(static_cast<unsigned>(response.status));
    answer_.set(http::field::content_type, response.type);
    answer_.set(http::field::cache_control, "no-store");
    answer_.set("X-Content-Type-Options", "nosniff");
    answer_.set("Referrer-Policy", "no-referrer");
    answer_.keep_alive(false);
    answer_.body() = std::move(response.body);
    answer_.prepare_payload();
    stream_.expires_after(request_time);
    http::async_write(stream_, answer_, [self = shared_from_this()](beast::error_code error, std::size_t) {
      if (error) return;
      beast::error_code ignored;
      self->stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
      self->in_.clear();
      self->discard(most_left);
    });
  }

  // A lingering close: what still comes of a refused request is read and thrown away. A socket that is closed before
  // that resets the connection, and the client may never see its answer.
  void discard(std::size_t left) {
    stream_.async_read_some(in_.prepare(std::min(left, most_head)),
                            [self = shared_from_this(), left](beast::error_code error, std::size_t size) {
                              if (!error && size < left) self->discard(left - size);
                            });
  }

  beast::tcp_stream stream_;
  const Server::Rules& rules_;
  TakeSocket take_socket_;
  beast::flat_buffer in_;
  http::request_parser<http::string_body> parser_;
  http::response<http::string_body> answer_;
};

}  // namespace

class Server::Inside {
 public:
  Inside(const std::string& address, std::uint16_t port, Rules rules, Listener& listener)
      : rules_(std::move(rules)), listener_(listener), acceptor_(context_) {
    beast::error_code error;
    const auto at = asio::ip::make_address_v4(address, error);
    if (error)
      throw Error(Exit::invalid_input, "--address: \"" + address + "\" is no address; expected one such as 127.0.0.1");
    const tcp::endpoint endpoint(at, port);
    acceptor_.open(endpoint.protocol(), error);
    if (!error) acceptor_.set_option(asio::socket_base::reuse_address(true), error);
    if (!error) acceptor_.bind(endpoint, error);
    if (!error) acceptor_.listen(16, error);
    if (error)
      throw Error(Exit::io,
                  "cannot serve at " + address + ':' + std::to_string(port) + ": " + system_message(error.value()));
    accept();
  }

  std::uint16_t port() const { return acceptor_.local_endpoint().port(); }

  void serve(double seconds) {
    using Clock = std::chrono::steady_clock;
    context_.restart();
    if (seconds > 0) {
      context_.run_for(std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds)));
      return;
    }
    for (const auto end = Clock::now() + at_once; context_.poll_one() > 0 && Clock::now() < end;) continue;
  }
  void wake() { context_.stop(); }

  void close(double patience) {
    for (const auto& client : clients_) client->close();
    const auto sent = [&] {
      std::uint64_t sum = 0;
      for (const auto& client : clients_) sum += client->sent();
      return sum;
    };
    for (auto before = sent(); prune(), !clients_.empty();) {
      serve(patience);
      const auto now = sent();
      if (now == before) return;
      before = now;
    }
  }

 private:
  void accept() {
    acceptor_.async_accept([this](beast::error_code error, tcp::socket socket) {
      if (!error) take(std::move(socket));
      if (error != asio::error::operation_aborted) accept();
    });
  }

  void take(tcp::socket socket) {
    const auto made = std::make_shared<Connection>(
        std::move(socket), rules_,
        [this](beast::tcp_stream& stream, WebSocket::Request request, const HttpRequest& asked) {
          return take_socket(stream, std::move(request), asked);
        });
    made->read();
    connections_.remove_if([](const auto& one) { return one.expired(); });
    connections_.push_back(made);
    if (connections_.size() <= most_connections) return;
    if (const auto oldest = connections_.front().lock()) oldest->close();
    connections_.pop_front();
  }

  bool take_socket(beast::tcp_stream& stream, WebSocket::Request request, const HttpRequest& asked) {
    prune();
    const auto offered = asked.headers.find("sec-websocket-protocol");
    const std::string chosen = offered == asked.headers.end() ? "" : subprotocol(offered->second);
    if (chosen.empty() || clients_.size() >= most_clients) return false;
    clients_.push_back(std::make_shared<WebSocket>(std::move(stream), listener_));
    clients_.back()->accept(std::move(request), chosen);
    return true;
  }

  // The first that the client offers and we speak.
  std::string subprotocol(const std::string& offered) const {
    std::istringstream words(offered);
    for (std::string word; std::getline(words, word, ',');) {
      const auto first = word.find_first_not_of(' '), last = word.find_last_not_of(' ');
      if (first == word.npos) continue;
      const auto known =
          std::find(rules_.subprotocols.begin(), rules_.subprotocols.end(), word.substr(first, last - first + 1));
      if (known != rules_.subprotocols.end()) return *known;
    }
    return "";
  }

  void prune() {
    clients_.remove_if([](const auto& one) { return one->is_gone(); });
  }

  Rules rules_;
  Listener& listener_;
  asio::io_context context_{1};
  tcp::acceptor acceptor_;
  std::list<std::weak_ptr<Connection>> connections_;
  std::list<std::shared_ptr<WebSocket>> clients_;
};

Server::Server(const std::string& address, std::uint16_t port, Rules rules, Listener& listener)
    : inside_(std::make_unique<Inside>(address, port, std::move(rules), listener)) {}
Server::~Server() = default;
std::uint16_t Server::port() const { return inside_->port(); }
void Server::serve(double seconds) { inside_->serve(seconds); }
void Server::wake() { inside_->wake(); }
void Server::close(double patience) { inside_->close(patience); }

}  // namespace muster::live
