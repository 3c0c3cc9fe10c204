// A routing protocol, and the fabric that carries its packets. Each radio decides by its own receptions alone.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "packet.hpp"

namespace muster::routing {

// Outcomes of a copy of a request; where it met several, the last of these counts.
enum class Outcome : std::uint8_t { delivered = 0, lost, gone, queue_full, no_route, ttl_expired, count };

class Fabric {
 public:
  virtual ~Fabric() = default;
  virtual double now() const = 0;  // s
  // Gives a packet to the network, for one neighbour or for all that hear it.
  virtual void send(Radio at, Radio to, Packet packet) = 0;
  // Gives it to the controllers of a radio.
  virtual void deliver(Radio at, const Packet& packet) = 0;
  // Drops it here.
  virtual void end(const Packet& packet, Outcome outcome) = 0;
  // Keeps it until a route is found; drops it if too many wait.
  virtual void park(Radio at, Packet packet) = 0;
  virtual std::vector<Packet> unpark(Radio at, Radio target) = 0;
  // True at the radio's first reception of the request. Equals an unlimited memory of each radio.
  virtual bool is_first(Radio at, const Packet& packet) = 0;
};

// One object decides for all radios. Its state is its bytes: the same bytes make the same future.
class Protocol {
 public:
  virtual ~Protocol() = default;
  virtual void originate(Fabric& fabric, Radio at, Packet packet) = 0;
  virtual void receive(Fabric& fabric, Radio at, Radio from, Packet packet) = 0;
  // A packet to a neighbour did not arrive, by the network's acknowledgements.
  virtual void lost_neighbour(Fabric&, Radio /*at*/, Radio /*neighbour*/) {}
  virtual void forget(Radio /*at*/) {}  // it left
  virtual void pass_time(Fabric&) {}
  virtual bool parks() const { return false; }
  virtual std::string save() const { return {}; }
  virtual void load(std::string_view) {}

 protected:
  // One hop more, if its time to live allows.
  static void pass_on(Fabric& fabric, Radio at, Radio to, Packet packet) {
    if (packet.ttl <= 1) return fabric.end(packet, Outcome::ttl_expired);
    --packet.ttl;
    fabric.send(at, to, std::move(packet));
  }
};

}  // namespace muster::routing
