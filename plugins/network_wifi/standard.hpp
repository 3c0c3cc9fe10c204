// Constants of IEEE 802.11-2016 for ERP-OFDM (802.11g): its clause 18 over clause 17, in a network of such stations
// alone, with either slot.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "medium/channel.hpp"

namespace muster::wifi {

using medium::Time;

constexpr Time microsecond = 1000;
constexpr Time sifs = 10 * microsecond;
constexpr Time long_slot = 20 * microsecond;  // of a network without access point, or with stations of 802.11b
constexpr Time short_slot = 9 * microsecond;
constexpr Time preamble = 16 * microsecond, signal_field = 4 * microsecond, symbol = 4 * microsecond;
constexpr Time extension = 6 * microsecond;  // of every frame, without signal
constexpr Time detection = 4 * microsecond;  // aCCATime: a frame is detected this long after its begin
constexpr int least_window = 15, most_window = 1023;

// Of channels 1 to 13 at 2.4 GHz.
constexpr medium::Band band_of(int channel) {
  const double middle = 2407e6 + 5e6 * channel;
  return {middle - 10e6, middle + 10e6};
}

// Octets. A larger payload is sent in pieces, each with a header of 8 octets, like fragments of IPv6 (RFC 8200).
constexpr std::size_t header = 24 + 8 + 4;  // of the frame, of LLC and SNAP, and its check sequence
constexpr std::size_t ack_frame = 14;
constexpr std::size_t in_one_frame = 2304 - 8;  // aMSDUMaxSize less LLC and SNAP
constexpr std::size_t fragment_header = 8;
constexpr std::size_t in_a_fragment = in_one_frame - fragment_header;

constexpr std::size_t frames_of(std::size_t payload) {
  return payload <= in_one_frame ? 1 : (payload + in_a_fragment - 1) / in_a_fragment;
}
constexpr std::size_t frame_size(std::size_t payload, std::size_t n) {
  if (payload <= in_one_frame) return header + payload;
  return header + fragment_header + std::min(in_a_fragment, payload - n * in_a_fragment);
}

struct Rate {
  int mbit;          // a second; 4 of them are a symbol's data bits
  int carrier_bits;  // a subcarrier and symbol
  int coding;        // of the convolutional code: 1 for 1/2, 2 for 2/3, 3 for 3/4
  int ack_mbit;      // of its acknowledgement: the highest mandatory rate that is no higher
};
constexpr std::array<Rate, 8> rates{{{6, 1, 1, 6},
                                     {9, 1, 3, 6},
                                     {12, 2, 1, 12},
                                     {18, 2, 3, 12},
                                     {24, 4, 1, 24},
                                     {36, 4, 3, 24},
                                     {48, 6, 2, 24},
                                     {54, 6, 3, 24}}};

// Sensitivity at each rate that the standard demands, in dBm (17.3.10.2, which 18.4.8.2 adopts).
constexpr std::array<double, 8> sensitivities{-82, -81, -79, -77, -74, -70, -66, -65};

constexpr std::size_t rate_of(int mbit) {
  std::size_t i = 0;
  while (rates[i].mbit != mbit) ++i;
  return i;
}

// 16 service bits before, 6 tail bits behind.
constexpr Time air_time(std::size_t size, const Rate& rate) {
  const auto bits = static_cast<Time>(16 + 8 * size + 6), a_symbol = 4 * static_cast<Time>(rate.mbit);
  return preamble + signal_field + (bits + a_symbol - 1) / a_symbol * symbol + extension;
}
constexpr Time ack_time(const Rate& rate) { return air_time(ack_frame, rates[rate_of(rate.ack_mbit)]); }

// Bit error rate after decoding at a ratio of signal to noise and interference: the carriers' error rate in white
// noise, and the union bound of a hard decision Viterbi decoder (Pei and Henderson, Validation of OFDM error rate model
// in ns-3, 2010; weights of the code: Haccoun and Begin, 1989).
inline double bit_error_rate(const Rate& rate, double ratio) {
  const auto tail = [](double x) { return std::erfc(std::sqrt(x)); };
  const double raw = rate.carrier_bits == 1   ? tail(ratio) / 2
                     : rate.carrier_bits == 2 ? tail(ratio / 2) / 2
                     : rate.carrier_bits == 4 ? tail(ratio / 10) * 3 / 8
                                              : tail(ratio / 42) * 7 / 24;
  const double d = std::sqrt(4 * raw * (1 - raw));
  const auto bound = [&](const auto& weights, int distance, int step) {
    double sum = 0;
    for (std::size_t i = 0; i < weights.size(); ++i)
      sum += weights[i] * std::pow(d, distance + step * static_cast<int>(i));
    return sum / (2 * rate.coding);
  };
  constexpr std::array<double, 9> half{36, 211, 1404, 11633, 77433, 502690, 3322763, 21292910, 134365911};
  constexpr std::array<double, 10> two_thirds{3, 70, 285, 1276, 6160, 27128, 117019, 498860, 2103891, 8784123};
  constexpr std::array<double, 10> three_quarters{42,     201,     1492,     10469,    62935,
                                                  379644, 2253373, 13073811, 75152755, 428005675};
  const double sum = rate.coding == 1   ? bound(half, 10, 2)
                     : rate.coding == 2 ? bound(two_thirds, 6, 1)
                                        : bound(three_quarters, 5, 1);
  return std::clamp(sum, 0.0, 0.5);
}

}  // namespace muster::wifi
