#include "live/websocket.hpp"

#include <array>
#include <boost/asio/post.hpp>
#include <utility>

namespace muster::live {
namespace {

namespace beast = boost::beast;
namespace websocket = beast::websocket;

constexpr std::size_t most_received = 1024 * 1024;  // bytes of a message

}  // namespace

void WebSocket::accept(Request request, const std::string& subprotocol) {
  request_ = std::move(request);
  stream_.next_layer().expires_never();  // the websocket has its own timeouts
  stream_.set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
  stream_.set_option(websocket::stream_base::decorator([subprotocol](websocket::response_type& response) {
    response.set(beast::http::field::sec_websocket_protocol, subprotocol);
  }));
  stream_.read_message_max(most_received);
  stream_.async_accept(request_, [self = shared_from_this()](beast::error_code error) {
    if (error) return self->lost();
    self->state_ = State::open;
    self->listener_.opened(*self);
    self->read();
  });
}

void WebSocket::read() {
  stream_.async_read(in_, [self = shared_from_this()](beast::error_code error, std::size_t) {
    if (error) return self->lost();
    if (self->state_ == State::open) {
      const auto bytes = self->in_.cdata();
      self->listener_.received(*self, {static_cast<const char*>(bytes.data()), bytes.size()},
                               self->stream_.got_binary());
    }
    self->in_.consume(self->in_.size());
    if (self->is_open()) self->read();
  });
}

void WebSocket::send(Frame frame) {
  if (state_ != State::open) return;
  bytes_ += frame.size();
  waiting_.push_back(std::move(frame));
  for (std::size_t at = 0; bytes_ > most_waiting && waiting_.size() > 1 && at < waiting_.size();) {
    if (!waiting_[at].may_drop) {
      ++at;
      continue;
    }
    bytes_ -= waiting_[at].size();
    waiting_.erase(waiting_.begin() + static_cast<std::ptrdiff_t>(at));
    ++dropped_;
  }
  if (bytes_ > most_waiting && waiting_.size() > 1) return lost();
  write();
}

void WebSocket::write() {
  if (is_writing_ || state_ == State::closed) return;
  if (waiting_.empty()) {
    if (state_ != State::ending) return;
    is_writing_ = true;
    return stream_.async_close(websocket::close_code::going_away,
                               [self = shared_from_this()](beast::error_code) { self->lost(); });
  }
  is_writing_ = true;
  being_written_ = std::move(waiting_.front());
  waiting_.pop_front();
  const Frame& frame = being_written_;
  stream_.binary(frame.is_binary);
  const std::array<boost::asio::const_buffer, 2> parts{
      boost::asio::buffer(frame.head), frame.body ? boost::asio::buffer(*frame.body) : boost::asio::const_buffer()};
  stream_.async_write(parts, [self = shared_from_this()](beast::error_code error, std::size_t) {
    if (error) return self->lost();
    self->written();
  });
}

void WebSocket::written() {
  is_writing_ = false;
  ++sent_;
  if (state_ == State::closed) return;  // it was lost meanwhile
  bytes_ -= being_written_.size();
  if (dropped_ > 0 && bytes_ < most_waiting / 2 && state_ == State::open)
    listener_.caught_up(*this, std::exchange(dropped_, 0));
  write();
}

void WebSocket::close() {
  if (state_ != State::open) return;
  state_ = State::ending;
  write();
}

// What is being written must stay until its handler is called. The listener may be sending to all its clients just now,
// and is told later.
void WebSocket::lost() {
  if (state_ == State::closed) return;
  const bool was_open = is_open();
  state_ = State::closed;
  beast::error_code ignored;
  stream_.next_layer().socket().close(ignored);
  if (was_open)
    boost::asio::post(stream_.get_executor(), [self = shared_from_this()] { self->listener_.closed(*self); });
}

}  // namespace muster::live
