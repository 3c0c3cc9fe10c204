// Radios that all share one channel of 802.11g, for tests.
#pragma once

#include <cmath>

#include "medium.hpp"
#include "peers/ours.hpp"

namespace muster::wifi {

constexpr Time second = 1'000'000'000;

inline Settings settings(int mbit = 6) {
  Settings s;
  s.noise = medium::milliwatts(-93.966);
  s.busy = medium::milliwatts(-62);
  s.rate = rate_of(mbit);
  s.queue = 1'000'000;
  return s;
}

// Radios at 16 dBm.
struct Cell {
  explicit Cell(const std::vector<std::array<double, 2>>& at, uint64_t seed = 7)
      : channel(peers::channel_of(at, 16, -82)), medium{Stream(seed)} {}
  // Removes the links between `one` and `other`.
  void hide(std::size_t one, std::size_t other) {
    for (const std::size_t link : {one * channel.radios + other, other * channel.radios + one})
      channel.power[link] = 0, channel.rssi[link] = std::nan("");
  }
  Report run(const Settings& s, Time until = second) { return medium.run(0, until, channel, s); }

  Channel channel;
  Medium medium;
};

}  // namespace muster::wifi
