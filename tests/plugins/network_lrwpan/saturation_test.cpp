// Saturated devices of a star in slotted CSMA/CA, against closed forms. Row 25 of the requirements.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numeric>

#include "medium.hpp"
#include "peers/ours.hpp"
#include "slotted_models.hpp"

namespace muster::lrwpan {
namespace {

constexpr Time second = 1'000'000'000, millisecond = second / 1000;  // by then the first beacon is heard
constexpr int spacing = static_cast<int>(long_spacing / unit_backoff);

// All radios receive all at equal power, 1.25 dB above noise: a frame of 560 to 1040 bits arrives alone with a
// probability of 0.994 or more, beside another of 0.007 or less.
Channel cell(std::size_t radios) {
  Channel channel = peers::channel_of(std::vector<std::array<double, 2>>(radios));
  for (std::size_t from = 0; from < radios; ++from)
    for (std::size_t to = 0; to < radios; ++to)
      if (from != to) channel.power[from * radios + to] = 1, channel.rssi[from * radios + to] = 0;
  return channel;
}

// Share of the time with a frame that arrives. The radio 0 is the coordinator; each other one always has frames of so
// many slots for it.
double saturated(int devices, int slots_of_frame) {
  const auto radios = static_cast<std::size_t>(devices) + 1;
  const Channel channel = cell(radios);
  Settings s;
  s.noise = medium::milliwatts(-1.25);
  s.busy = 0.5;
  s.acknowledged = false;
  s.queue = 1000;
  s.beacon_order = s.superframe_order = 11;
  const auto octets = static_cast<std::size_t>(slots_of_frame * unit_backoff / octet);
  const std::string payload(octets - preamble - header, 'x');
  Medium medium{Stream(static_cast<uint64_t>(devices))};
  std::vector<std::uint64_t> wanted(radios, 300);
  std::size_t arrived = 0;
  constexpr int seconds = 200;
  for (int tick = 0; tick < seconds; ++tick) {
    for (std::size_t i = 1; i < radios; ++i)
      for (std::uint64_t k = 0; k < wanted[i]; ++k) medium.ask(tick * second + millisecond, i, 0, payload);
    const Report& report = medium.run(tick * second, (tick + 1) * second, channel, s);
    arrived += report.arrivals.size();
    for (std::size_t i = 1; i < radios; ++i)
      wanted[i] = std::accumulate(report.fates[i].begin() + 1, report.fates[i].end(), std::uint64_t{0});
  }
  return static_cast<double>(arrived) * static_cast<double>(slots_of_frame * unit_backoff) / (1.0 * seconds * second);
}

class SlottedSaturation : public testing::TestWithParam<std::tuple<int, int>> {
 protected:
  const int devices = std::get<0>(GetParam()), frame = std::get<1>(GetParam());
};
INSTANTIATE_TEST_SUITE_P(Devices, SlottedSaturation,
                         testing::Combine(testing::Values(1, 2, 3, 5, 10, 15, 20, 30, 50), testing::Values(7, 10, 13)));

// Pollin's holds where many devices make the state of one tell little of the channel's: from 15 to 20 of them with
// frames of 10 slots.
TEST_P(SlottedSaturation, Row25ThroughputIsThatOfTheMarkovModels) {
  const double got = saturated(devices, frame), expected = slotted::conditioned(devices, frame, spacing);
  const double pollin = slotted::pollin(devices, frame, spacing);
  std::printf("%d devices, frames of %d slots: %.4f; conditioned %.4f, %+.1f %%; Pollin %.4f, %+.1f %%\n", devices,
              frame, got, expected, 100 * (got / expected - 1), pollin, 100 * (got / pollin - 1));
  EXPECT_NEAR(got, expected, 0.05 * expected);
  if (frame == 10 && (devices == 15 || devices == 20)) {
    EXPECT_NEAR(got, pollin, 0.05 * pollin);
  }
}

// One device alone waits 3.5 periods in the mean, assesses twice, sends, and keeps its spacing.
TEST(OneDevice, Row25AloneIsThatOfItsCycle) {
  for (const int frame : {7, 10, 13}) {
    const double cycle = 3.5 + contention_window + frame + spacing;
    EXPECT_NEAR(saturated(1, frame), frame / cycle, 0.015 * frame / cycle);
    EXPECT_NEAR(slotted::conditioned(1, frame, spacing), frame / cycle, 1e-9);
  }
}

}  // namespace
}  // namespace muster::lrwpan
