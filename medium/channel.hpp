// The channel between radios, by their numbers, during one run.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "medium/jammer.hpp"

namespace muster::medium {

struct Channel {
  std::size_t radios = 0;
  std::vector<double> power;  // mW, [from x radios + to]; 0 where there is no link
  std::vector<double> rssi;   // dBm, the same, as the receiver reports it; NaN: nothing received
  std::vector<Jammer> jammers;
  std::vector<std::uint8_t> alive;
  std::vector<std::uint64_t> keys;  // random key of each radio

  const double* power_from(std::size_t from) const { return &power[from * radios]; }
  const double* rssi_from(std::size_t from) const { return &rssi[from * radios]; }
};

inline double milliwatts(double dbm) {
  constexpr double neper = 0.23025850929940457;  // ln(10) / 10: an exponential takes a sixth of the time of a power
  return std::exp(neper * dbm);
}

}  // namespace muster::medium
