// Frames of 802.15.4 under a jammer, against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "medium.hpp"
#include "peers/ours.hpp"

namespace muster::lrwpan {
namespace {

using medium::Jammer;
using medium::milliwatts;
using medium::Pulses;
using peers::add;
using peers::Books;
using peers::of;

constexpr Time second = 1'000'000'000;
constexpr double signal = 1e-8;  // mW, far above the noise
constexpr std::size_t payload = 40;
constexpr Time frame = (6 + 11 + 40) * octet;

// A sender, a receiver, and a jammer with a link to the receiver only.
struct Jammed {
  explicit Jammed(double power, const Pulses& pulses = {}) {
    channel = peers::channel_of({{0, 0}, {3, 0}});
    channel.power = {0, signal, signal, 0};
    channel.jammers = {Jammer{2, band_of(11), pulses, {0, power}}};
    settings.noise = 1e-11;
    settings.busy = 1e-9;
    settings.acknowledged = false;
    settings.queue = 1'000'000;
  }
  // One frame in each of so many twentieths of a second, at any moment of it.
  Report send(int frames) {
    for (int i = 0; i < frames; ++i) {
      const double moment = Stream(11).uniform(static_cast<uint64_t>(i));
      medium.ask(i * (second / 20) + std::llround(5e7 * moment), 0, 1, std::string(payload, 'x'));
    }
    return medium.run(0, frames * (second / 20), channel, settings);
  }
  double share_of(int frames, DeliveryOutcome fate) {
    Books books{};
    add(books, send(frames));
    return of(books, fate) / frames;
  }

  Channel channel;
  Settings settings;
  Medium medium{Stream(3)};
};

// (1 - bit error rate)^bits, at the signal's ratio to jammer and noise.
TEST(SteadyJammer, LeavesWhatTheBitErrorLawSays) {
  constexpr int frames = 3000;
  double least = 1, most = 0;
  for (const double above : {-2.0, -1.5, -1.0, -0.5, 0.0, 0.5, 1.0, 6.0}) {  // the signal above the jammer, dB
    const double power = signal / milliwatts(above);
    const auto bits = frame / bit;
    const double expected = std::pow(1 - bit_error_rate(signal / (power + 1e-11)), static_cast<double>(bits));
    const double three_sigma = 3 * std::sqrt(expected * (1 - expected) / frames) + 1e-3;
    Jammed one(power);
    EXPECT_NEAR(one.share_of(frames, DeliveryOutcome::delivered), expected, three_sigma) << above;
    least = std::min(least, expected), most = std::max(most, expected);
  }
  EXPECT_LT(least, 0.3);
  EXPECT_GT(most, 0.999);
}

TEST(SteadyJammer, WhatItTakesIsCountedAsCollided) {
  Jammed one(1.5 * signal);
  Books books{};
  add(books, one.send(1000));
  EXPECT_GT(of(books, DeliveryOutcome::collided), 100);
  EXPECT_EQ(of(books, DeliveryOutcome::collided) + of(books, DeliveryOutcome::delivered), 1000);
}

// Only the part of its power within the receiver's 5 MHz counts.
TEST(SteadyJammer, OfAWideSpectrumOnlyItsPartCounts) {
  Jammed narrow(signal), wide(10 * signal), beside(1e3 * signal);
  wide.channel.jammers[0].band = {2402.5e6 - 10e6, 2402.5e6 + 40e6};
  beside.channel.jammers[0].band = band_of(12);
  EXPECT_EQ(narrow.share_of(1000, DeliveryOutcome::delivered), wide.share_of(1000, DeliveryOutcome::delivered));
  EXPECT_EQ(beside.share_of(1000, DeliveryOutcome::delivered), 1);
  beside.settings.channel = 12;
  EXPECT_LT(beside.share_of(1000, DeliveryOutcome::delivered), 0.01);
}

// A radio that receives it above the threshold never finds the channel free; below, it has no effect.
TEST(Assessment, HearsAJammer) {
  for (const Cca cca : {Cca::standard, Cca::ns3, Cca::instant}) {
    for (const double above : {0.99, 1.01}) {
      Jammed one(0);
      one.settings.cca = cca;
      one.channel.jammers[0].power = {above * one.settings.busy, 0};
      EXPECT_EQ(one.share_of(200, above > 1 ? DeliveryOutcome::no_access : DeliveryOutcome::delivered), 1) << above;
    }
    Jammed beside(0);
    beside.channel.jammers[0].power = {1, 0};
    beside.channel.jammers[0].band = band_of(12);
    EXPECT_EQ(beside.share_of(200, DeliveryOutcome::delivered), 1);
  }
}

// The standard's assessment takes the mean over 8 symbols: with half of the time on, twice the power is needed.
TEST(Assessment, IsOfTheMeanPowerOfPulses) {
  for (const double above : {0.99, 1.01}) {
    Jammed one(0, {cca_window / 4, cca_window / 8, 0});
    one.channel.jammers[0].power = {2 * above * one.settings.busy, 0};
    EXPECT_EQ(one.share_of(200, above > 1 ? DeliveryOutcome::no_access : DeliveryOutcome::delivered), 1) << above;
  }
}

// A strong pulse destroys each frame that it overlaps by more than some bits, and no other.
TEST(Pulses, TakeTheFramesThatTheyOverlap) {
  constexpr int frames = 4000;
  constexpr Time slack = 20 * bit;
  const Pulses pulses{13'000'000, 4'000'000, 1'700'000};
  Jammed one(1e6 * signal, pulses);
  one.settings.retries = 0;
  const Report report = one.send(frames);
  for (const auto& arrival : report.arrivals)
    EXPECT_LT(pulses.on_between(arrival.received - frame, arrival.received), slack);
  const double overlapped = static_cast<double>(pulses.on + frame) / static_cast<double>(pulses.period);
  const double delivered = static_cast<double>(report.deliveries.size()) / frames;
  const double three_sigma = 3 * std::sqrt(overlapped * (1 - overlapped) / frames);
  EXPECT_NEAR(1 - delivered, overlapped, three_sigma + 2.0 * slack / static_cast<double>(pulses.period));
}

// Pulses far shorter than a frame act by the share of its bits that they hit, not by their mean power.
TEST(Pulses, ShorterThanAFrameTakeTheirShareOfItsBits) {
  constexpr int frames = 3000;
  const double power = signal / milliwatts(-1.5);
  Jammed one(power, {bit * 8, bit * 4, 0});
  const auto whole = frame / bit;
  const double bits = static_cast<double>(whole) / 2;
  const double expected = std::pow(1 - bit_error_rate(signal / (power + 1e-11)), bits);
  EXPECT_NEAR(one.share_of(frames, DeliveryOutcome::delivered), expected,
              3 * std::sqrt(expected * (1 - expected) / frames));
  const double by_the_mean = std::pow(1 - bit_error_rate(signal / (power / 2 + 1e-11)), 2 * bits);
  EXPECT_GT(by_the_mean - expected, 0.3);
}

// The division into ticks does not matter, nor does saving and loading the medium between them.
TEST(Pulses, AreTheSameForAnyTicks) {
  std::string ends[2];
  for (const int ticks : {1, 37}) {
    Jammed one(1e3 * signal, {1'300'000, 400'000, 0});
    one.channel.jammers[0].power[0] = 2 * one.settings.busy;
    for (int tick = 0; tick < ticks; ++tick) {
      const Time from = tick * second / ticks, until = (tick + 1) * second / ticks;
      for (int i = 0; i < 300; ++i)
        if (const Time at = i * second / 300; at >= from && at < until)
          one.medium.ask(at, static_cast<std::size_t>(i) % 2, Medium::everyone, std::string(30, 'x'));
      one.medium.run(from, until, one.channel, one.settings);
      Medium next{Stream(3)};
      next.load(one.medium.save());
      one.medium = next;
    }
    ends[ticks > 1] = one.medium.save();
  }
  EXPECT_TRUE(ends[0] == ends[1]);
}

}  // namespace
}  // namespace muster::lrwpan
