// Constants of the Bluetooth Core Specification 2.0 for the basic rate: its volume 2, part A (radio) and part B
// (baseband).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "medium/channel.hpp"

namespace muster::bluetooth {

using medium::Time;

constexpr Time bit = 1000;        // 1 Mbit/s
constexpr Time slot = 625 * bit;  // the master begins in even ones, a slave in odd ones
constexpr Time turn = 2 * slot;   // from one slot of the master's to its next
constexpr int most_slaves = 7;    // an active slave's address has 3 bits, and 0 is for broadcasts
constexpr int channels = 79;      // 1 MHz each, from 2402 MHz up
constexpr Time access_code = 72 * bit;
constexpr Time header = 54 * bit;            // 18 bits, each sent three times
constexpr Time bare = access_code + header;  // the whole of a POLL and of a NULL

// Packets without error correction of their payload (part B, ACL packets).
struct Type {
  int slots;
  std::size_t header, payload;  // octets
};
constexpr std::array<Type, 3> types{{{1, 1, 27}, {3, 2, 183}, {5, 2, 339}}};  // DH1, DH3, DH5
enum { dh1 = 0, dh3, dh5 };
constexpr std::size_t check = 2;  // octets at a payload's end

// The shortest allowed packet type for this payload, or the largest allowed one.
constexpr std::size_t type_for(std::size_t payload, std::size_t largest) {
  std::size_t type = dh1;
  while (type < largest && types[type].payload < payload) ++type;
  return type;
}
constexpr Time air_time(std::size_t type, std::size_t payload) {
  return bare + static_cast<Time>(8 * (types[type].header + payload + check)) * bit;
}

// A message is one frame of L2CAP (volume 3, part A, 3.1), cut into packets; its limit of 64 kB is not enforced.
constexpr std::size_t l2cap_header = 4;

constexpr medium::Band band_of(int channel) {
  const double middle = 2402e6 + 1e6 * channel;
  return {middle - 0.5e6, middle + 0.5e6};
}

// Bit error rate at a ratio of signal to noise and interference: binary FSK of modulation index 0.315, the middle of
// the allowed range, detected noncoherently (Proakis, Digital communications, 4th edition, 5.4.4; Marcum's function as
// a series of Bessel functions).
inline double bit_error_rate(double ratio) {
  if (ratio > 200) return 0;  // below 1e-24
  constexpr double turned = 2 * 3.14159265358979323846 * 0.315;
  const double correlation = std::sin(turned) / turned, apart = std::sqrt(1 - correlation * correlation);
  const double a = std::sqrt(ratio / 2 * (1 - apart)), b = std::sqrt(ratio / 2 * (1 + apart));
  double sum = std::cyl_bessel_i(0.0, a * b) / 2;
  double power = a / b;
  for (int k = 1; k < 30; ++k, power *= a / b) sum += power * std::cyl_bessel_i(static_cast<double>(k), a * b);
  return std::min(0.5, std::exp(-ratio / 2) * sum);
}

// Error rate of a bit that is sent three times.
inline double header_error_rate(double ratio) {
  const double wrong = bit_error_rate(ratio);
  return wrong * wrong * (3 - 2 * wrong);
}

}  // namespace muster::bluetooth
