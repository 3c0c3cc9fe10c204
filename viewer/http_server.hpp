// A small HTTP server for one page at one address of this computer. It runs in the caller's thread: requests are
// answered while serve() lasts, and no request can stop it.
#pragma once

#include <cstdint>
#include <functional>
#include <list>
#include <map>
#include <string>

namespace muster::viewer {

struct HttpRequest {
  std::string method, path;
  std::map<std::string, std::string> query, headers;  // headers in lower case
};

struct HttpResponse {
  int status = 200;
  std::string type = "text/plain; charset=utf-8", body{};
};

class HttpServer {
 public:
  using Handler = std::function<HttpResponse(const HttpRequest&)>;
  // Port 0: one that is free. Throws Error.
  HttpServer(const std::string& address, uint16_t port, Handler handler);
  ~HttpServer();
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  uint16_t port() const { return port_; }
  // Answers what comes within so many seconds; 0: what is there already.
  void serve(double seconds);

 private:
  struct Connection {
    int socket;
    std::string in, out;
    bool answered = false;
  };
  void take(Connection& connection);
  bool is_done(Connection& connection, short events);

  Handler handler_;
  int listener_ = -1;
  uint16_t port_ = 0;
  std::list<Connection> connections_;
};

}  // namespace muster::viewer
