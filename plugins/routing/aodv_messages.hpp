// AODV's messages: requests and replies in the layout of RFC 3561.
#pragma once

#include "aodv.hpp"

namespace muster::routing {

enum class Message : std::uint8_t { request = 1, reply, error };

inline Packet control(medium::Writer& message, int ttl) {
  Packet packet;
  packet.kind = Packet::Kind::control;
  packet.ttl = static_cast<std::uint8_t>(ttl);
  packet.payload = message.take();
  return packet;
}

// RREQ, section 5.1: 24 bytes.
struct Aodv::Request {
  std::uint8_t is_sequence_unknown = 0, hops = 0;
  std::uint32_t number = 0;
  Radio to = 0;
  std::uint32_t to_sequence = 0;
  Radio from = 0;
  std::uint32_t from_sequence = 0;

  Packet packet(int ttl) const {
    medium::Writer out;
    out.put(Message::request), out.put(is_sequence_unknown), out.put(std::uint8_t{0}), out.put(hops), out.put(number);
    out.put(to), out.put(to_sequence), out.put(from), out.put(from_sequence);
    return control(out, ttl);
  }
  explicit Request(medium::Reader& in) {
    in.get(is_sequence_unknown), in.get<std::uint8_t>(), in.get(hops), in.get(number);
    in.get(to), in.get(to_sequence), in.get(from), in.get(from_sequence);
  }
  Request() = default;
};

// RREP, section 5.2: 20 bytes.
struct Aodv::Reply {
  std::uint8_t hops = 0;
  Radio to = 0;  // the destination of the route
  std::uint32_t to_sequence = 0;
  Radio from = 0;              // the route's originator
  std::uint32_t lifetime = 0;  // ms

  Packet packet(int ttl) const {
    medium::Writer out;
    out.put(Message::reply), out.put(std::uint16_t{0}), out.put(hops);
    out.put(to), out.put(to_sequence), out.put(from), out.put(lifetime);
    return control(out, ttl);
  }
  explicit Reply(medium::Reader& in) {
    in.get<std::uint16_t>(), in.get(hops), in.get(to), in.get(to_sequence), in.get(from), in.get(lifetime);
  }
  Reply() = default;
};

}  // namespace muster::routing
