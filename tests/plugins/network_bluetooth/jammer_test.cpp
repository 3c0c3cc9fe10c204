// A hopping piconet under a jammer, against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "medium.hpp"
#include "peers/ours.hpp"

namespace muster::bluetooth {
namespace {

using medium::DeliveryOutcome;
using medium::Jammer;
using medium::Pulses;
using peers::add;
using peers::Books;
using peers::of;

constexpr Time second = 1'000'000'000;
constexpr double signal = 1e-6, noise = 1e-12;  // mW

// A master, a slave, and a third radio that jams so many of the first channels, with this power in each of them.
struct Jammed {
  Jammed(double power, int width, const Pulses& pulses = {}) {
    channel = peers::channel_of({{0, 0}, {3, 0}, {0, 3}});
    for (double& each : channel.power) each = signal;
    channel.jammers = {Jammer{2, {2401.5e6, 2401.5e6 + 1e6 * width}, pulses, {power * width, power * width, 0}}};
    settings.noise = noise;
    settings.flush = 0;
    settings.queue = 1'000'000;
  }
  Report send(int messages, std::size_t to, Time until) {
    for (int i = 0; i < messages; ++i) medium.ask(0, 0, to, std::string(types[dh3].payload - l2cap_header, 'x'));
    return medium.run(0, until, channel, settings);
  }
  // Arrival rate of broadcasts, which are sent once.
  double share(int messages) {
    Books books{};
    add(books, send(messages, Medium::everyone, messages * (5 * slot)));
    EXPECT_EQ(of(books, DeliveryOutcome::no_link), messages);  // the third radio's copies
    EXPECT_EQ(of(books, DeliveryOutcome::delivered) + of(books, DeliveryOutcome::collided), messages);
    return of(books, DeliveryOutcome::delivered) / messages;
  }

  Channel channel;
  Settings settings;
  Medium medium{Stream(3)};
};

TEST(Hops, VisitEachChannelAsOften) {
  Jammed one(0, 1);
  one.medium.run(0, second, one.channel, one.settings);
  constexpr int each = 400;
  std::array<int, channels> visits{};
  for (int i = 0; i < each * channels; ++i) ++visits[static_cast<std::size_t>(one.medium.channel_at(i * slot))];
  double chi_square = 0;
  for (const int count : visits) chi_square += std::pow(count - each, 2) / each;
  EXPECT_NEAR(chi_square, channels - 1, 4 * std::sqrt(2.0 * (channels - 1)));
}

// A jammer of some channels destroys the packets sent in them.
TEST(Hops, LoseTheShareOfChannelsThatIsJammed) {
  constexpr int messages = 3000;
  for (const int width : {1, 20, 40, 79}) {
    const double expected = 1 - width / 79.0;
    Jammed one(1e6 * signal, width);
    EXPECT_NEAR(one.share(messages), expected, 3 * std::sqrt(expected * (1 - expected) / messages)) << width;
  }
}

// Acknowledged messages arrive all the same; a try needs two good channels, one in each direction.
TEST(Hops, RetransmissionsFindAnotherChannel) {
  for (const int width : {10, 40}) {
    Jammed one(1e6 * signal, width);
    const Report report = one.send(20000, 1, 20 * second);
    const double both = std::pow(1 - width / 79.0, 2), tries = 20.0 * second / (4 * slot);
    EXPECT_NEAR(static_cast<double>(report.deliveries.size()), tries * both, 3 * std::sqrt(tries * both)) << width;
  }
}

TEST(SteadyJammer, LeavesWhatTheBitErrorLawSays) {
  constexpr int messages = 3000;
  double least = 1, most = 0;
  for (const double above : {10.0, 11.0, 12.0, 13.0, 14.0, 16.0}) {  // the signal above the jammer, dB
    const double power = signal / medium::milliwatts(above), ratio = signal / (power + noise);
    const auto whole = (air_time(dh3, types[dh3].payload) - bare) / bit;
    const auto bits = static_cast<double>(whole);
    const double expected = std::pow(1 - header_error_rate(ratio), 18) * std::pow(1 - bit_error_rate(ratio), bits);
    Jammed one(power, channels);
    EXPECT_NEAR(one.share(messages), expected, 3 * std::sqrt(expected * (1 - expected) / messages) + 1e-3) << above;
    least = std::min(least, expected), most = std::max(most, expected);
  }
  EXPECT_LT(least, 0.01);
  EXPECT_GT(most, 0.99);
}

// A strong pulse destroys each packet that it overlaps, and no other.
TEST(Pulses, TakeThePacketsThatTheyOverlap) {
  constexpr Time length = air_time(dh3, types[dh3].payload);
  constexpr Time slack = 20 * bit;
  const Pulses pulses{17'310'000, 6'100'000, 0};
  Jammed one(1e6 * signal, channels, pulses);
  const Report report = one.send(4000, Medium::everyone, 20 * second);
  for (const auto& arrival : report.arrivals)
    EXPECT_LT(pulses.on_between(arrival.received - length + access_code, arrival.received), slack);
  int kept = 0;
  for (int i = 0; i < 4000; ++i) kept += pulses.on_between(i * 4 * slot, i * 4 * slot + length) < slack;
  EXPECT_NEAR(static_cast<double>(report.deliveries.size()), kept, 0.01 * kept);
}

}  // namespace
}  // namespace muster::bluetooth
