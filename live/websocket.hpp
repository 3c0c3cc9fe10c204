// One websocket, and what waits to be sent over it.
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <deque>
#include <memory>
#include <string>

#include "live/server.hpp"

namespace muster::live {

class WebSocket : public Client, public std::enable_shared_from_this<WebSocket> {
 public:
  using Request = boost::beast::http::request<boost::beast::http::string_body>;

  WebSocket(boost::beast::tcp_stream stream, Listener& listener) : stream_(std::move(stream)), listener_(listener) {}

  // Answers the request that asked for it.
  void accept(Request request, const std::string& subprotocol);
  void send(Frame frame) override;
  // After what waits was sent.
  void close();

  bool is_open() const { return state_ == State::open || state_ == State::ending; }
  bool is_gone() const { return state_ == State::closed; }
  std::uint64_t sent() const { return sent_; }

 private:
  enum class State { opening, open, ending, closed };
  void read();
  void write();
  void written();
  void lost();

  boost::beast::websocket::stream<boost::beast::tcp_stream> stream_;
  Listener& listener_;
  Request request_;
  boost::beast::flat_buffer in_;
  std::deque<Frame> waiting_;
  Frame being_written_;    // where is_writing_: it stays where it is until its handler is called
  std::size_t bytes_ = 0;  // of them all
  std::uint64_t dropped_ = 0, sent_ = 0;
  bool is_writing_ = false;
  State state_ = State::opening;
};

}  // namespace muster::live
