#include "peer.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstring>

#include "ports/frame.hpp"

namespace muster::bridge {

using namespace ports;

namespace {

using Clock = std::chrono::steady_clock;

class Deadline {
 public:
  explicit Deadline(double seconds)
      : end_(Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds))) {}
  int milliseconds() const {
    const double left = std::chrono::duration<double, std::milli>(end_ - Clock::now()).count();
    return static_cast<int>(std::min(1e9, std::max(0.0, std::ceil(left))));
  }

 private:
  Clock::time_point end_;
};

// True where the descriptor is ready, or has failed, before the deadline.
bool ready(int descriptor, short events, const Deadline& deadline) {
  pollfd one{descriptor, events, 0};
  const int count = ::poll(&one, 1, deadline.milliseconds());
  if (count < 0 && errno == EINTR) throw Interrupted{};
  return count > 0;
}

[[noreturn]] void fail(const std::string& place) {
  const std::string reason = errno == EADDRINUSE ? "somebody listens there already; expected an address of its own"
                                                 : std::string(std::strerror(errno));
  throw std::runtime_error("cannot listen at " + place + ": " + reason);
}

Descriptor listen_at_port(uint16_t port, std::string& place) {
  place = "127.0.0.1:" + std::to_string(port);
  Descriptor made(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (!made) fail(place);
  const int on = 1;
  ::setsockopt(made.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  auto* any = reinterpret_cast<sockaddr*>(&address);
  if (::bind(made.get(), any, size) != 0 || ::listen(made.get(), 1) != 0) fail(place);
  if (::getsockname(made.get(), any, &size) == 0) place = "127.0.0.1:" + std::to_string(ntohs(address.sin_port));
  return made;
}

Descriptor listen_at_path(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.size() >= sizeof address.sun_path)
    throw std::runtime_error("cannot listen at " + path + ": a Unix socket's path has at most " +
                             std::to_string(sizeof address.sun_path - 1) + " bytes");
  std::memcpy(address.sun_path, path.c_str(), path.size() + 1);
  const auto* any = reinterpret_cast<const sockaddr*>(&address);
  // A socket that an ended run has left behind refuses connections: it is taken over.
  const Descriptor probe(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
  if (::connect(probe.get(), any, sizeof address) != 0 && errno == ECONNREFUSED) ::unlink(path.c_str());
  Descriptor made(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (!made || ::bind(made.get(), any, sizeof address) != 0 || ::listen(made.get(), 1) != 0) fail(path);
  return made;
}

bool would_block() { return errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR; }

}  // namespace

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
  close();
  std::swap(number_, other.number_);
  return *this;
}

void Descriptor::close() {
  if (number_ >= 0) ::close(number_);
  number_ = -1;
}

Peer::Peer(uint16_t port, const std::string& path) : place_(path) {
  listener_ = path.empty() ? listen_at_port(port, place_) : listen_at_path(path);
  path_ = path;
}

Peer::~Peer() {
  if (!path_.empty()) ::unlink(path_.c_str());
}

bool Peer::accept(double seconds) {
  drop();
  if (!ready(listener_.get(), POLLIN, Deadline(seconds))) return false;
  client_ = Descriptor(::accept4(listener_.get(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
  const int on = 1;
  if (client_ && path_.empty()) ::setsockopt(client_.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  return has_client();
}

void Peer::drop() {
  client_.close();
  unsent_.clear();
  unread_.clear();
}

bool Peer::send(const std::string& bytes, double seconds) {
  unsent_ += bytes;
  const Deadline deadline(seconds);
  while (has_client() && !unsent_.empty()) {
    const auto sent = ::send(client_.get(), unsent_.data(), unsent_.size(), MSG_NOSIGNAL);
    if (sent > 0)
      unsent_.erase(0, static_cast<std::size_t>(sent));
    else if (!would_block())
      drop();
    else if (!ready(client_.get(), POLLOUT, deadline))
      return true;
  }
  return has_client();
}

bool Peer::take_frame(std::string& frame) {
  if (unread_.size() < header_bytes) return false;
  const auto length = FrameReader(unread_).integer<uint32_t>();
  if (length == 0 || length > most_bytes) {
    std::string shown;
    for (std::size_t i = 0; i < std::min<std::size_t>(unread_.size(), 8); ++i) {
      constexpr char digits[] = "0123456789abcdef";
      const auto byte = static_cast<uint8_t>(unread_[i]);
      shown += {' ', digits[byte >> 4], digits[byte & 15]};
    }
    throw Malformed("bytes that are no frame:" + shown);
  }
  if (unread_.size() < header_bytes + length) return false;
  frame = unread_.substr(header_bytes, length);
  unread_.erase(0, header_bytes + length);
  return true;
}

Peer::Got Peer::receive(std::string& frame, double seconds) {
  const Deadline deadline(seconds);
  while (!take_frame(frame)) {
    if (!has_client()) return Got::gone;
    char bytes[65536];
    const auto got = ::recv(client_.get(), bytes, sizeof bytes, 0);
    if (got > 0)
      unread_.append(bytes, static_cast<std::size_t>(got));
    else if (got == 0 || !would_block())
      return drop(), Got::gone;
    else if (!send("", 0) ||
             !ready(client_.get(), static_cast<short>(POLLIN | (unsent_.empty() ? 0 : POLLOUT)), deadline))
      return has_client() ? Got::nothing : Got::gone;
  }
  return Got::frame;
}

}  // namespace muster::bridge
