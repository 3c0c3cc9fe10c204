#include "http_server.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstring>
#include <sstream>
#include <vector>

#include "text/error.hpp"

namespace muster::viewer {
namespace {

constexpr std::size_t most_head = 16384;      // bytes of a request
constexpr std::size_t most_connections = 32;  // a browser opens six

const char* reason(int status) {
  switch (status) {
    case 200:
      return "OK";
    case 204:
      return "No Content";
    case 400:
      return "Bad Request";
    case 403:
      return "Forbidden";
    case 404:
      return "Not Found";
    default:
      return "Method Not Allowed";
  }
}

std::map<std::string, std::string> parsed_query(const std::string& text) {
  std::map<std::string, std::string> result;
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, '&');) {
    const auto equals = std::min(part.find('='), part.size());
    result[part.substr(0, equals)] = equals < part.size() ? part.substr(equals + 1) : "";
  }
  return result;
}

// False where it is no request of HTTP.
bool parse(const std::string& head, HttpRequest& request) {
  std::istringstream lines(head);
  std::string target, version, line;
  if (!(lines >> request.method >> target >> version) || version.rfind("HTTP/1.", 0) != 0 || target[0] != '/')
    return false;
  const auto mark = std::min(target.find('?'), target.size());
  request.path = target.substr(0, mark);
  if (mark < target.size()) request.query = parsed_query(target.substr(mark + 1));
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    const auto colon = line.find(':');
    if (colon == line.npos) continue;
    std::string name = line.substr(0, colon);
    std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
    const auto value = line.find_first_not_of(' ', colon + 1);
    request.headers[name] = value == line.npos ? "" : line.substr(value);
  }
  return true;
}

std::string text_of(const HttpResponse& response) {
  return "HTTP/1.1 " + std::to_string(response.status) + ' ' + reason(response.status) +
         "\r\nContent-Type: " + response.type + "\r\nContent-Length: " + std::to_string(response.body.size()) +
         "\r\nConnection: close\r\nCache-Control: no-store\r\nX-Content-Type-Options: nosniff\r\n"
         "Referrer-Policy: no-referrer\r\n\r\n" +
         response.body;
}

}  // namespace

HttpServer::HttpServer(const std::string& address, uint16_t port, Handler handler) : handler_(std::move(handler)) {
  sockaddr_in at{};
  at.sin_family = AF_INET;
  at.sin_port = htons(port);
  if (::inet_pton(AF_INET, address.c_str(), &at.sin_addr) != 1)
    throw Error(Exit::invalid_input, "--address: \"" + address + "\" is no address; expected one such as 127.0.0.1");
  listener_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  const int on = 1;
  ::setsockopt(listener_, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  socklen_t size = sizeof at;
  auto* any = reinterpret_cast<sockaddr*>(&at);
  if (::bind(listener_, any, size) != 0 || ::listen(listener_, 16) != 0) {
    const std::string why = system_message(errno);
    ::close(listener_);
    throw Error(Exit::io, "cannot serve at " + address + ':' + std::to_string(port) + ": " + why);
  }
  ::getsockname(listener_, any, &size);
  port_ = ntohs(at.sin_port);
}

HttpServer::~HttpServer() {
  for (const auto& connection : connections_) ::close(connection.socket);
  ::close(listener_);
}

void HttpServer::take(Connection& connection) {
  HttpRequest request;
  HttpResponse response{400, "text/plain; charset=utf-8", "no request of HTTP\n"};
  if (parse(connection.in, request)) response = handler_(request);
  connection.out = text_of(response);
  connection.answered = true;
}

bool HttpServer::is_done(Connection& connection, short events) {
  const auto waits = [] { return errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR; };
  if (events && !connection.answered) {
    char bytes[4096];
    const auto got = ::recv(connection.socket, bytes, sizeof bytes, 0);
    if (got == 0 || (got < 0 && !waits())) return true;
    if (got > 0) connection.in.append(bytes, static_cast<std::size_t>(got));
    if (connection.in.find("\r\n\r\n") != std::string::npos || connection.in.size() > most_head) take(connection);
  }
  while (!connection.out.empty()) {
    const auto sent = ::send(connection.socket, connection.out.data(), connection.out.size(), MSG_NOSIGNAL);
    if (sent < 0) return !waits();
    connection.out.erase(0, static_cast<std::size_t>(sent));
  }
  if (connection.answered) ::shutdown(connection.socket, SHUT_WR);
  return connection.answered;
}

void HttpServer::serve(double seconds) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  while (true) {
    std::vector<pollfd> waiting{{listener_, POLLIN, 0}};
    for (const auto& one : connections_)
      waiting.push_back({one.socket, static_cast<short>(one.answered ? POLLOUT : POLLIN), 0});
    const double left = std::chrono::duration<double, std::milli>(end - Clock::now()).count();
    const int ready = ::poll(waiting.data(), waiting.size(), static_cast<int>(std::ceil(std::max(0.0, left))));
    if (ready <= 0) return;  // time is up, or a signal came
    auto at = waiting.begin() + 1;
    for (auto one = connections_.begin(); one != connections_.end(); ++at) {
      if (at->revents && is_done(*one, at->revents)) {
        ::close(one->socket);
        one = connections_.erase(one);
      } else {
        ++one;
      }
    }
    if (!waiting[0].revents) continue;
    const int made = ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
    if (made < 0) continue;
    connections_.push_back({made, {}, {}});
    if (connections_.size() <= most_connections) continue;
    ::close(connections_.front().socket);
    connections_.pop_front();
  }
}

}  // namespace muster::viewer
