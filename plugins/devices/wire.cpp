#include "wire.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <muster/plugin.hpp>

#include "datagram.hpp"

namespace muster::devices {
namespace {

sockaddr_in socket_address(const Address& address) {
  sockaddr_in result{};
  result.sin_family = AF_INET;
  result.sin_port = htons(address.port);
  result.sin_addr.s_addr = htonl(address.host);
  return result;
}

Address from_socket(const sockaddr_in& address) { return {ntohl(address.sin_addr.s_addr), ntohs(address.sin_port)}; }

}  // namespace

std::string Address::text() const {
  std::string result;
  for (int shift = 24; shift >= 0; shift -= 8) result += std::to_string(host >> shift & 255) + (shift ? "." : ":");
  return result + std::to_string(port);
}

Address address_of(const std::string& host, std::uint16_t port) {
  in_addr parsed{};
  if (::inet_pton(AF_INET, host.c_str(), &parsed) != 1)
    throw BadInput("attribute \"address\": \"" + host + "\" is no address; expected four numbers, such as 127.0.0.1");
  return {ntohl(parsed.s_addr), port};
}

UdpSocket::UdpSocket(const Address& at) : at_(at) {
  descriptor_ = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  sockaddr_in name = socket_address(at);
  socklen_t size = sizeof name;
  auto* any = reinterpret_cast<sockaddr*>(&name);
  if (descriptor_ < 0 || ::bind(descriptor_, any, size) != 0 || ::getsockname(descriptor_, any, &size) != 0) {
    const std::string why = errno == EADDRINUSE ? "somebody is there already; expected a port of its own"
                                                : std::string(std::strerror(errno));
    if (descriptor_ >= 0) ::close(descriptor_);
    throw BadInput("cannot listen at " + at.text() + ": " + why);
  }
  at_ = from_socket(name);
}

UdpSocket::~UdpSocket() { ::close(descriptor_); }

void UdpSocket::send(const Address& to, const std::string& bytes) {
  const sockaddr_in name = socket_address(to);
  ::sendto(descriptor_, bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&name), sizeof name);
}

bool UdpSocket::receive(Address& from, std::string& bytes) {
  sockaddr_in name{};
  socklen_t size = sizeof name;
  bytes.resize(most_datagram_bytes);
  // A port at which nobody listens is an error of the next call: nothing has come.
  const auto got = ::recvfrom(descriptor_, bytes.data(), bytes.size(), 0, reinterpret_cast<sockaddr*>(&name), &size);
  bytes.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
  from = from_socket(name);
  return got >= 0;
}

void RoughWire::at(double now) {
  now_ = now;
  left_ = most_at_once;
  send_due();
}

void RoughWire::send_due() {
  for (Underway due; take(out_, now_, due);) inner_.send(due.other, due.bytes);
}

void RoughWire::put(std::vector<Underway>& to, const Address& other, const std::string& bytes) {
  const std::uint64_t which = count_++;
  if (random_.uniform(which, 0) < settings_.loss) return;
  to.push_back({now_ + settings_.delay + settings_.jitter * random_.uniform(which, 1), other, bytes});
}

bool RoughWire::take(std::vector<Underway>& from, double now, Underway& taken) {
  const auto first =
      std::min_element(from.begin(), from.end(), [](const Underway& a, const Underway& b) { return a.due < b.due; });
  if (first == from.end() || first->due > now) return false;
  taken = std::move(*first);
  from.erase(first);
  return true;
}

void RoughWire::send(const Address& to, const std::string& bytes) {
  put(out_, to, bytes);
  send_due();
}

bool RoughWire::receive(Address& from, std::string& bytes) {
  for (; left_ > 0 && inner_.receive(from, bytes); --left_) put(in_, from, bytes);
  Underway due;
  if (!take(in_, now_, due)) return false;
  from = due.other;
  bytes = std::move(due.bytes);
  return true;
}

}  // namespace muster::devices
