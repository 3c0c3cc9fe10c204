// Packets between routers: the payload of a network's messages.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "medium/bytes.hpp"

namespace muster::routing {

using Radio = std::uint32_t;
constexpr Radio everyone = UINT32_MAX;

struct Packet {
  enum class Kind : std::uint8_t { data = 1, control };
  Kind kind = Kind::data;
  std::uint8_t ttl = 1;  // hops left
  // Of data.
  Radio origin = 0, target = everyone;
  std::uint32_t journey = 0;  // the request's number, from 1 on
  double t_sent = 0;          // time of the request
  // A controller's payload, or one of the protocol's own messages.
  std::string payload;
};

constexpr std::size_t data_head = 22;  // bytes

inline std::string encoded(const Packet& packet) {
  medium::Writer out;
  out.put(packet.kind), out.put(packet.ttl);
  if (packet.kind == Packet::Kind::data)
    out.put(packet.origin), out.put(packet.target), out.put(packet.journey), out.put(packet.t_sent);
  return out.take().append(packet.payload);
}

// Throws std::runtime_error if the bytes end early.
inline Packet decoded(std::string_view bytes) {
  medium::Reader in(bytes);
  Packet packet;
  in.get(packet.kind), in.get(packet.ttl);
  const bool is_data = packet.kind == Packet::Kind::data;
  if (is_data) in.get(packet.origin), in.get(packet.target), in.get(packet.journey), in.get(packet.t_sent);
  packet.payload = bytes.substr(is_data ? data_head : 2);
  return packet;
}

}  // namespace muster::routing
