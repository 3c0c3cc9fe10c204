// Constants of IEEE 802.15.4-2006 for its 2.4 GHz band, where a symbol is 4 bits and takes 16 us. MAC constants have
// the standard's default values.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "medium/channel.hpp"

namespace muster::lrwpan {

using medium::Time;

constexpr Time symbol = 16000;
constexpr Time octet = 2 * symbol;
constexpr Time unit_backoff = 20 * symbol;  // aUnitBackoffPeriod
constexpr Time turnaround = 12 * symbol;    // aTurnaroundTime
constexpr Time cca_window = 8 * symbol;
constexpr Time ack_wait = 54 * symbol;                                   // macAckWaitDuration
constexpr Time short_spacing = 12 * symbol, long_spacing = 40 * symbol;  // of frames: after up to 18 octets, and more
constexpr int least_exponent = 3, most_exponent = 5, most_backoffs = 4;  // macMinBE, macMaxBE, macMaxCSMABackoffs
constexpr Time bit = symbol / 4;

constexpr Time base_superframe = 16 * 60 * symbol;  // aBaseSuperframeDuration
constexpr int no_beacons = 15;                      // macBeaconOrder of a PAN without beacons
constexpr int most_lost_beacons = 4;                // aMaxLostBeacons
constexpr int contention_window = 2;                // CW: assessments of slotted CSMA/CA

// Band of channels 11 to 26. A receiver's filter passes all between its neighbours, consistent with its noise.
constexpr medium::Band band_of(int channel) {
  const double middle = 2405e6 + 5e6 * (channel - 11);
  return {middle - 2.5e6, middle + 2.5e6};
}

constexpr std::size_t largest_frame = 127;  // aMaxPHYPacketSize
constexpr std::size_t preamble = 6;         // preamble, start of frame, length
constexpr std::size_t header = 11;  // control, sequence, PAN, two short addresses in one PAN; check sequence at the end
constexpr std::size_t extended_header = header + 2 * (8 - 2);  // the same with two extended addresses
constexpr std::size_t sender_pan = 2;  // more, to a receiver in another PAN: the header then has the sender's PAN too
constexpr std::size_t ack_frame = 5;

// Control, sequence, PAN, sender's address; superframe, reserved slots and pending addresses; check sequence.
constexpr std::size_t beacon_frame(bool extended) { return 2 + 1 + 2 + (extended ? 8 : 2) + 2 + 1 + 1 + 2; }

// Fragments of RFC 4944: all but the last carry a multiple of 8 octets after a header of 4, then of 5.
constexpr std::size_t in_one_frame(std::size_t head) { return largest_frame - head; }
constexpr std::size_t in_a_fragment(std::size_t head) { return (in_one_frame(head) - 5) / 8 * 8; }

constexpr std::size_t frames_of(std::size_t payload, std::size_t head) {
  return payload <= in_one_frame(head) ? 1 : (payload + in_a_fragment(head) - 1) / in_a_fragment(head);
}

// Octets of the n-th frame of a payload, from its control field on.
constexpr std::size_t frame_size(std::size_t payload, std::size_t n, std::size_t head) {
  if (payload <= in_one_frame(head)) return head + payload;
  const std::size_t before = std::min(payload, n * in_a_fragment(head));
  return head + (n == 0 ? 4 : 5) + std::min(in_a_fragment(head), payload - before);
}

constexpr Time air_time(std::size_t size) { return static_cast<Time>(preamble + size) * octet; }
constexpr Time spacing_after(std::size_t size) { return size > 18 ? long_spacing : short_spacing; }

// Bit error rate at a ratio of signal to noise and interference (IEEE 802.15.4-2006, annex E.4.1.8).
inline double bit_error_rate(double ratio) {
  constexpr double binomial[] = {120,  -560,  1820, -4368, 8008, -11440, 12870, -11440,
                                 8008, -4368, 1820, -560,  120,  -16,    1};
  double sum = 0;
  for (int k = 2; k <= 16; ++k) sum += binomial[k - 2] * std::exp(20 * ratio * (1.0 / k - 1));
  return std::clamp(8.0 / 15 / 16 * sum, 0.0, 0.5);
}

}  // namespace muster::lrwpan
