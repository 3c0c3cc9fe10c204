// Frames of 802.11g under a jammer, against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "medium.hpp"
#include "peers/ours.hpp"

namespace muster::wifi {
namespace {

using medium::Jammer;
using medium::milliwatts;
using medium::Pulses;
using peers::add;
using peers::Books;
using peers::of;

constexpr Time second = 1'000'000'000;
constexpr double signal = 1e-7;  // mW, far above the noise
constexpr double noise = 1e-10;
constexpr std::size_t payload = 1000;

// A sender, a receiver, and a jammer with a link to the receiver only.
struct Jammed {
  explicit Jammed(double power, const Pulses& pulses = {}) {
    channel = peers::channel_of({{0, 0}, {3, 0}});
    channel.power = {0, signal, signal, 0};
    channel.jammers = {Jammer{2, band_of(1), pulses, {0, power}}};
    settings.noise = noise;
    settings.busy = milliwatts(-62);
    settings.rate = rate_of(24);
    settings.acknowledged = false;
    settings.queue = 1'000'000;
  }
  Report send(int frames) {
    for (int i = 0; i < frames; ++i) {
      const double moment = Stream(11).uniform(static_cast<uint64_t>(i));
      medium.ask(i * (second / 100) + std::llround(9e6 * moment), 0, 1, std::string(payload, 'x'));
    }
    return medium.run(0, frames * (second / 100), channel, settings);
  }
  double share_of(int frames, DeliveryOutcome fate) {
    Books books{};
    add(books, send(frames));
    return of(books, fate) / frames;
  }
  Time frame() const { return air_time(header + payload, rates[settings.rate]); }

  Channel channel;
  Settings settings;
  Medium medium{Stream(3)};
};

// The head's 24 bits at 6 Mbit/s, and then whole symbols of 96 bits.
TEST(SteadyJammer, LeavesWhatTheBitErrorLawSays) {
  constexpr int frames = 3000;
  double least = 1, most = 0;
  for (const double above : {9.5, 9.8, 10.1, 10.4, 11.0, 13.0, 16.0}) {  // the signal above the jammer, dB
    Jammed one(signal / milliwatts(above));
    const double ratio = signal / (signal / milliwatts(above) + noise);
    const auto symbols = (one.frame() - preamble - signal_field - extension) / symbol;
    const double bits = 96.0 * static_cast<double>(symbols);
    const double expected = std::pow(1 - bit_error_rate(rates[0], ratio), 24) *
                            std::pow(1 - bit_error_rate(rates[rate_of(24)], ratio), bits);
    EXPECT_NEAR(one.share_of(frames, DeliveryOutcome::delivered), expected,
                3 * std::sqrt(expected * (1 - expected) / frames) + 1e-3)
        << above;
    least = std::min(least, expected), most = std::max(most, expected);
  }
  EXPECT_LT(least, 0.3);
  EXPECT_GT(most, 0.999);
}

TEST(SteadyJammer, OfAWideSpectrumOnlyItsPartCounts) {
  const double power = signal / milliwatts(10);
  Jammed narrow(power), wide(4 * power), beside(1e3 * signal);
  wide.channel.jammers[0].band = {2412e6 - 30e6, 2412e6 + 50e6};
  beside.channel.jammers[0].band = band_of(5);
  EXPECT_EQ(narrow.share_of(1000, DeliveryOutcome::delivered), wide.share_of(1000, DeliveryOutcome::delivered));
  EXPECT_EQ(beside.share_of(1000, DeliveryOutcome::delivered), 1);
}

// A station that receives it above the threshold waits as long as it is on.
TEST(Access, WaitsForAJammerToEnd) {
  for (const double above : {0.99, 1.01}) {
    Jammed one(0);
    one.channel.jammers[0].power = {above * one.settings.busy, 0};
    EXPECT_EQ(one.share_of(200, DeliveryOutcome::delivered), above > 1 ? 0 : 1) << above;
    one.channel.jammers.clear();
    const Report& after = one.medium.run(2 * second, 3 * second, one.channel, one.settings);
    EXPECT_EQ(after.deliveries.size(), above > 1 ? 200u : 0u);
    if (above > 1) {
      EXPECT_GE(after.arrivals[0].received, 2 * second + sifs + 2 * one.settings.slot + one.frame());
    }
  }
}

// Between pulses it sends, after DIFS, and never begins during one; a pulse hits a frame too long for the gap.
TEST(Access, SendsBetweenPulses) {
  const Pulses pulses{5'000'000, 2'000'000, 300'000};
  Jammed one(0, pulses);
  one.channel.jammers[0].power = {2 * one.settings.busy, 0};
  const Report report = one.send(500);
  EXPECT_GT(report.arrivals.size(), 490u);
  for (const auto& arrival : report.arrivals) {
    const Time began = arrival.received - one.frame();
    EXPECT_EQ(pulses.on_between(began - 1, began), 0);
    const bool waited = began > arrival.sent;
    if (waited) {
      EXPECT_EQ(pulses.on_between(began - sifs - 2 * one.settings.slot, began), 0);
    }
  }
}

TEST(Pulses, TakeTheFramesThatTheyOverlap) {
  constexpr int frames = 4000;
  const Pulses pulses{3'700'000, 900'000, 0};
  Jammed one(1e6 * signal, pulses);
  const Report report = one.send(frames);
  const Time frame = one.frame();
  // No received part overlaps a pulse: the preamble's first 4 us, the head and the symbols.
  for (const auto& arrival : report.arrivals) {
    const Time begin = arrival.received - frame;
    EXPECT_EQ(pulses.on_between(begin, begin + detection), 0);
    EXPECT_LT(pulses.on_between(begin + preamble, arrival.received - extension), symbol);
  }
  const double overlapped = static_cast<double>(pulses.on + frame) / static_cast<double>(pulses.period);
  const double delivered = static_cast<double>(report.deliveries.size()) / frames;
  EXPECT_NEAR(1 - delivered, overlapped,
              3 * std::sqrt(overlapped * (1 - overlapped) / frames) + 30e3 / static_cast<double>(pulses.period));
}

// The division into ticks does not matter, nor does saving and loading the medium between them.
TEST(Pulses, AreTheSameForAnyTicks) {
  std::vector<Time> ends[2];
  for (const int ticks : {1, 37}) {
    Jammed one(1e3 * signal, {1'300'000, 400'000, 0});
    one.channel.jammers[0].power[0] = 2 * one.settings.busy;
    for (int tick = 0; tick < ticks; ++tick) {
      const Time from = tick * second / ticks, until = (tick + 1) * second / ticks;
      for (int i = 0; i < 500; ++i)
        if (const Time at = i * second / 500; at >= from && at < until)
          one.medium.ask(at, static_cast<std::size_t>(i) % 2, Medium::everyone, std::string(300, 'x'));
      for (const auto& arrival : one.medium.run(from, until, one.channel, one.settings).arrivals)
        ends[ticks > 1].push_back(arrival.received);
      Medium next{Stream(3)};
      next.load(one.medium.save());
      one.medium = next;
    }
  }
  EXPECT_GT(ends[0].size(), 300u);
  EXPECT_EQ(ends[0], ends[1]);
}

}  // namespace
}  // namespace muster::wifi
