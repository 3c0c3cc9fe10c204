// Interface of an external network simulator: the six callbacks that carry our messages through it.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace muster::external {

using Place = std::array<double, 3>;  // m, ENU

// The world at a tick. Radios by number; rows that joined come last, and numbers are permanent.
struct World {
  double time = 0;            // s, from which on it is valid
  std::vector<Place> places;  // of the radios
  std::vector<std::uint8_t> alive;
  std::vector<std::uint16_t> pans;  // of IEEE 802.15.4
  std::vector<double> level;        // dBm, [from x radios + to], as it is received; -infinity where there is no link
  std::vector<double> rssi;         // dBm, the same, as the receiver reports it; NaN: nothing received
  std::size_t radios() const { return places.size(); }
  std::size_t link(std::size_t from, std::size_t to) const { return from * radios() + to; }
};

constexpr std::size_t everyone = static_cast<std::size_t>(-1);

struct Request {
  std::uint64_t message;  // its number
  double at;              // s, not before the world's time
  std::size_t from, to;   // radios, or everyone
  std::string payload;
};

// A message received by a radio.
struct Arrival {
  std::uint64_t message;
  std::size_t to, hop;  // its receiver, and the sender of its last hop
  double at;            // s
  double rssi;          // dBm, of its last frame
  std::string payload;
};

// Ends of a message, after which no copy arrives. `lost`: on a route over several radios.
enum class End { sent = 1, no_access, no_ack, queue_full, lost };

class Backend {
 public:
  virtual ~Backend() = default;  // stop
  virtual void init(const World& world, std::uint64_t seed) = 0;
  // Called before each advance().
  virtual void moved(const World& world) = 0;
  virtual void request(Request request) = 0;
  // Calls deliver() for each receiver of a message, and end() once, after them.
  virtual void advance(double until) = 0;

  std::function<void(Arrival)> deliver;
  std::function<void(std::uint64_t message, End)> end;
};

}  // namespace muster::external
