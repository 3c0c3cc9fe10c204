// The piconet against the specification's times and rates, closed forms, and its own counts. tests/README.md lists the
// rows.
#include "medium.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "peers/ours.hpp"

namespace muster::bluetooth {
namespace {

using medium::Arrival;
using medium::milliwatts;
using peers::add;
using peers::Books;
using peers::channel_of;
using peers::of;

constexpr Time second = 1'000'000'000;
constexpr double noise = 1e-9;  // mW

// A master, radio 0, and slaves with links far above the noise.
struct Piconet {
  explicit Piconet(std::size_t slaves, uint64_t seed = 7) : medium{Stream(seed)} {
    channel = channel_of(std::vector<std::array<double, 2>>(1 + slaves, {0, 0}));
    set_ratio(1e6);
    settings.noise = noise;
    settings.flush = 0;
    settings.queue = 1'000'000;
  }
  void set_ratio(double ratio) {
    for (double& power : channel.power) power = ratio * noise;
    for (double& rssi : channel.rssi) rssi = 10 * std::log10(ratio * noise);
  }
  Report run(Time until = second) {
    const Time since = now;
    now = until;
    return medium.run(since, until, channel, settings);
  }
  // So many messages that each fill this type's packets to the last octet.
  void fill(std::size_t from, std::size_t to, std::size_t type, int messages, std::size_t packets = 1) {
    for (int i = 0; i < messages; ++i)
      medium.ask(0, from, to, std::string(packets * types[type].payload - l2cap_header, 'x'));
  }

  Channel channel;
  Settings settings;
  Medium medium;
  Time now = 0;
};

Books books_of(const Report& report) {
  Books books{};
  add(books, report);
  return books;
}

// kbit/s of one direction, L2CAP's header included.
double rate(const Report& report, std::size_t from, double seconds) {
  double bits = 0;
  for (const Arrival& a : report.arrivals)
    if (a.from == from) bits += 8.0 * static_cast<double>(a.payload.size() + l2cap_header);
  return 1e-3 * bits / seconds;
}

// ---- Times --------------------------------------------------------------------------------------------------------

TEST(AirTime, IsTheSpecifications) {
  EXPECT_EQ(bare, 126 * bit);
  EXPECT_EQ(air_time(dh1, 27), 366 * bit);
  EXPECT_EQ(air_time(dh3, 183), 1622 * bit);
  EXPECT_EQ(air_time(dh5, 339), 2870 * bit);
}

// ---- 24: properties of the mode -----------------------------------------------------------------------------------

// Bluetooth Core Specification 2.0, volume 2, part B, packet summary: greatest rates of asynchronous links, kbit/s.
TEST(Row24, RatesAreTheSpecifications) {
  struct Case {
    std::size_t down, up;
    double most_down, most_up;
  };
  for (const Case& c : {Case{dh1, dh1, 172.8, 172.8}, Case{dh3, dh3, 390.4, 390.4}, Case{dh5, dh5, 433.9, 433.9},
                        Case{dh3, dh1, 585.6, 86.4}, Case{dh5, dh1, 723.2, 57.6}, Case{dh1, dh5, 57.6, 723.2}}) {
    Piconet piconet(1);
    piconet.fill(0, 1, c.down, 9000);
    piconet.fill(1, 0, c.up, 9000);
    const Report report = piconet.run(10 * second);
    constexpr double a_packet = 8e-3 * 339 / 10;
    EXPECT_NEAR(rate(report, 0, 10), c.most_down, a_packet) << c.down << c.up;
    EXPECT_NEAR(rate(report, 1, 10), c.most_up, a_packet) << c.down << c.up;
  }
}

TEST(Row24, MessagesAreCutIntoPacketsOfTheLongestTypeAllowed) {
  for (const std::size_t largest : {dh1, dh3, dh5}) {
    Piconet piconet(1);
    piconet.settings.largest = largest;
    piconet.fill(0, 1, largest, 1, 100);
    const Report report = piconet.run();
    ASSERT_EQ(report.arrivals.size(), 1u);
    // 99 packets with a slot each for their acknowledgement, and the last.
    EXPECT_EQ(report.arrivals[0].received,
              99 * (types[largest].slots + 1) * slot + air_time(largest, types[largest].payload));
  }
}

TEST(Row24, APayloadArrivesByteForByte) {
  for (const std::size_t size : {0, 1, 23, 24, 335, 336, 5000}) {
    for (const std::size_t to : {std::size_t{1}, Medium::everyone}) {
      Piconet piconet(1);
      std::string payload(size, '\0');
      for (std::size_t i = 0; i < size; ++i) payload[i] = static_cast<char>(mixed(i));
      piconet.medium.ask(0, 0, to, payload);
      const Report report = piconet.run();
      ASSERT_EQ(report.deliveries.size(), 1u) << size;
      EXPECT_TRUE(report.arrivals[0].payload == payload) << size;
    }
  }
}

// Part A, 4.1: 0.1 % wrong bits at -70 dBm at the latest.
TEST(Row24, TheReferenceSensitivityIsAtAThousandthOfBits) {
  EXPECT_NEAR(bit_error_rate(milliwatts(-70) / milliwatts(-82.715)), 1e-3, 1e-5);
}

TEST(Row24, AnEighthSlaveIsRefused) {
  Piconet seven(7), eight(8);
  EXPECT_NO_THROW(seven.run());
  try {
    eight.run();
    FAIL() << "not refused";
  } catch (const TooManyRadios& e) {
    EXPECT_STREQ(e.what(), "9 radios; a piconet has one master and at most 7 slaves");
  }
  eight.channel.alive[3] = 0;
  EXPECT_NO_THROW(eight.run(2 * second));
}

TEST(Row24, SlavesTalkToTheirMasterAndToNobodyElse) {
  Piconet piconet(3);
  piconet.settings.master = 2;
  piconet.medium.ask(0, 0, 1, "x");
  piconet.medium.ask(0, 0, 2, "x");
  piconet.medium.ask(0, 1, Medium::everyone, "x");
  piconet.medium.ask(0, 2, Medium::everyone, "x");
  const Report report = piconet.run();
  EXPECT_EQ(of(books_of(report), DeliveryOutcome::delivered), 1 + 1 + 3);
  EXPECT_EQ(of(books_of(report), DeliveryOutcome::no_link), 1 + 2);
}

// ---- Access -------------------------------------------------------------------------------------------------------

// All are polled once in each interval, and their messages wait no longer than that and one round.
TEST(Polls, ReachEachIdleSlaveInTime) {
  for (const int interval : {20, 40, 100}) {
    Piconet piconet(7);
    piconet.settings.poll_interval = interval * slot;
    for (int i = 0; i < 300; ++i)
      piconet.medium.ask(i * (second / 10) + std::llround(1e8 * Stream(5).uniform(static_cast<uint64_t>(i))),
                         1 + static_cast<std::size_t>(i) % 7, 0, "x");
    const Report report = piconet.run(30 * second);
    ASSERT_EQ(report.arrivals.size(), 300u);
    double mean = 0;
    for (const Arrival& a : report.arrivals) {
      EXPECT_LE(a.received - a.sent, (interval + 2 * 7 + 2) * slot);
      mean += static_cast<double>(a.received - a.sent) / static_cast<double>(slot) / 300;
    }
    // The packet is requested at any moment of the interval, and waits for its own slot.
    EXPECT_NEAR(mean, interval / 2.0 + 1.4, 3 * interval / std::sqrt(12.0 * 300) + 0.5);
  }
}

// Saturated slaves share the air evenly, to the packet.
TEST(Polls, ShareTheAirEvenly) {
  Piconet piconet(7);
  for (std::size_t slave = 1; slave <= 7; ++slave) piconet.fill(slave, 0, dh3, 3000);
  const Report report = piconet.run(4 * second);
  std::array<int, 8> arrived{};
  for (const Arrival& a : report.arrivals) ++arrived[a.from];
  for (std::size_t slave = 1; slave <= 7; ++slave) EXPECT_NEAR(arrived[slave], 4.0 * 1600 / 4 / 7, 1.5) << slave;
}

// A master with constant data for one still polls the others: 2 slots each in 40.
TEST(Polls, GoOnBesideAStream) {
  Piconet piconet(7);
  piconet.fill(0, 1, dh5, 9000);
  const Report report = piconet.run(10 * second);
  EXPECT_NEAR(rate(report, 0, 10), 723.2 * (1 - 6 * 2 / 40.0), 723.2 * 0.04);
}

// A slave that had data and then vanishes is soon polled no more often than others.
TEST(Polls, LeaveASlaveBeThatFellSilent) {
  Piconet piconet(2);
  piconet.fill(0, 1, dh5, 9000);
  piconet.fill(2, 0, dh5, 9000);
  EXPECT_NEAR(rate(piconet.run(10 * second), 0, 10), 723.2 / 2, 1);
  for (const std::size_t link : {2 * 3 + 0, 0 * 3 + 2}) piconet.channel.power[link] = 0;
  EXPECT_NEAR(rate(piconet.run(20 * second), 0, 10), 723.2 * (1 - 2 / 40.0), 723.2 * 0.04);
}

// A swap may change the longest type in the middle of a message, and between two tries of a packet.
TEST(Packets, MayChangeTheirTypeOnTheWay) {
  Piconet piconet(1);
  piconet.set_ratio(milliwatts(14));
  std::string payload(20000, '\0');
  for (std::size_t i = 0; i < payload.size(); ++i) payload[i] = static_cast<char>(mixed(i));
  for (const std::size_t from : {0, 1}) piconet.medium.ask(0, from, 1 - from, payload);
  std::size_t arrived = 0;
  for (int i = 1; i < 2000; ++i) {
    piconet.settings.largest = static_cast<std::size_t>(i % 3);
    for (const Arrival& a : piconet.run(i * slot).arrivals) arrived += a.payload == payload;
  }
  EXPECT_EQ(arrived, 2u);
}

// ---- Losses -------------------------------------------------------------------------------------------------------

// Broadcasts are sent once: access code found, 18 bits of the header by majority of three, and the payload.
TEST(Loss, OfWhatIsSentOnceIsThatOfItsBits) {
  constexpr int frames = 3000;
  double least = 1, most = 0;
  for (const double decibels : {10.0, 11.0, 12.0, 13.0, 14.0, 16.0}) {
    const double ratio = milliwatts(decibels);
    Piconet piconet(1);
    piconet.set_ratio(ratio);
    piconet.fill(0, Medium::everyone, dh3, frames);
    const auto whole = (air_time(dh3, 183) - bare) / bit;
    const auto bits = static_cast<double>(whole);
    const double expected = std::pow(1 - header_error_rate(ratio), 18) * std::pow(1 - bit_error_rate(ratio), bits);
    const double got = of(books_of(piconet.run(60 * second)), DeliveryOutcome::delivered) / frames;
    EXPECT_NEAR(got, expected, 3 * std::sqrt(expected * (1 - expected) / frames) + 1e-3) << decibels;
    least = std::min(least, expected), most = std::max(most, expected);
  }
  EXPECT_LT(least, 0.01);
  EXPECT_GT(most, 0.99);
}

// With a short payload its header matters as well, though each of its bits is sent three times.
TEST(Loss, OfShortPacketsIsThatOfTheirHeadersToo) {
  constexpr int frames = 10000;
  const double wrong = bit_error_rate(milliwatts(8.5));
  Piconet piconet(1);
  piconet.set_ratio(milliwatts(8.5));
  for (int i = 0; i < frames; ++i) piconet.medium.ask(0, 0, Medium::everyone, "");
  const double of_three = 3 * wrong * wrong * (1 - wrong) + wrong * wrong * wrong;
  const double expected = std::pow(1 - of_three, 18) * std::pow(1 - wrong, 8 * (1 + 4 + 2));
  const double got = of(books_of(piconet.run(60 * second)), DeliveryOutcome::delivered) / frames;
  EXPECT_NEAR(got, expected, 3 * std::sqrt(expected * (1 - expected) / frames));
  EXPECT_LT(std::pow(1 - of_three, 18), 0.95);
}

// A packet is repeated until its acknowledgement arrives. Only whole packets and whole acknowledgements count: the rate
// is the full one times the probability of both.
TEST(Retransmission, CostsWhatTheLossOfPacketsAndAnswersSays) {
  const double ratio = milliwatts(12.5);
  Piconet piconet(1);
  piconet.set_ratio(ratio);
  piconet.fill(0, 1, dh5, 20000);
  const Report report = piconet.run(60 * second);
  const double heads = std::pow(1 - header_error_rate(ratio), 18);
  const auto whole = (air_time(dh5, 339) - bare) / bit;
  const auto bits = static_cast<double>(whole);
  const double both = heads * std::pow(1 - bit_error_rate(ratio), bits) * heads;
  EXPECT_LT(both, 0.2);
  EXPECT_NEAR(rate(report, 0, 60), 723.2 * both, 723.2 * 3 * std::sqrt(both / 16000));
  EXPECT_EQ(report.arrivals.size(), report.deliveries.size());
}

// A packet may be sent so often before its time is over; the rest of it is then lost.
TEST(Flush, GivesUpAfterItsTime) {
  constexpr int messages = 3000, tries = 8;
  const double ratio = milliwatts(11.5);
  Piconet piconet(1);
  piconet.set_ratio(ratio);
  piconet.settings.flush = tries * 4 * slot;
  for (int i = 0; i < messages; ++i) piconet.medium.ask(i * (second / 40), 0, 1, std::string(183 - 4, 'x'));
  const Books books = books_of(piconet.run(messages * (second / 40)));
  const auto whole = (air_time(dh3, 183) - bare) / bit;
  const auto bits = static_cast<double>(whole);
  const double lost = 1 - std::pow(1 - header_error_rate(ratio), 18) * std::pow(1 - bit_error_rate(ratio), bits);
  const double expected = std::pow(lost, tries);
  EXPECT_GT(expected, 0.2);
  EXPECT_NEAR(of(books, DeliveryOutcome::too_weak) / messages, expected, 3 * std::sqrt(expected / messages));
  EXPECT_EQ(of(books, DeliveryOutcome::too_weak) + of(books, DeliveryOutcome::delivered), messages);
}

// Without received acknowledgements: a message in one packet has arrived; of a longer one the sender drops the rest.
TEST(Flush, WithoutAcknowledgementsEndsAMessageOfSeveralPackets) {
  for (const std::size_t size : {std::size_t{40}, std::size_t{400}}) {
    Piconet piconet(1);
    piconet.settings.flush = 80 * slot;
    piconet.channel.power[1 * 2 + 0] = 0;
    piconet.channel.rssi[1 * 2 + 0] = std::nan("");
    piconet.medium.ask(0, 0, 1, std::string(size, 'x'));
    const Report report = piconet.run();
    EXPECT_EQ(report.deliveries.size(), size == 40 ? 1u : 0u);  // once, though it is repeated
    EXPECT_EQ(of(books_of(report), size == 40 ? DeliveryOutcome::delivered : DeliveryOutcome::no_ack), 1);
  }
}

// A slave that is never polled does not send; in the end it drops its message, for the reason of its missed polls.
TEST(Flush, EndsWhatNobodyAsksFor) {
  Piconet piconet(1);
  piconet.settings.flush = 80 * slot;
  piconet.channel.power[0 * 2 + 1] = 0;
  piconet.channel.rssi[0 * 2 + 1] = std::nan("");
  piconet.medium.ask(second / 2, 1, 0, "x");
  EXPECT_EQ(of(books_of(piconet.run()), DeliveryOutcome::no_link), 1);
}

TEST(Joining, IsNoticedByAMasterThatWasAlone) {
  Piconet piconet(1);
  piconet.channel.alive[1] = 0;
  piconet.run(second);
  piconet.channel.alive[1] = 1;
  piconet.medium.ask(second, 1, 0, "x");
  EXPECT_EQ(of(books_of(piconet.run(2 * second)), DeliveryOutcome::delivered), 1);
}

// Each copy has one outcome through all changes of the master.
TEST(Master, MayBecomeAnotherAtAnyTime) {
  Piconet piconet(3);
  piconet.settings.flush = 80 * slot;
  Books books{};
  for (int i = 1; i < 2000; ++i) {
    piconet.settings.master = static_cast<std::size_t>(i / 23) % 4;
    const auto from = static_cast<std::size_t>(i) % 4;
    if (i % 3 == 0)
      piconet.medium.ask(piconet.now, from, i % 2 ? (from + 1) % 4 : Medium::everyone, std::string(300, 'x'));
    add(books, piconet.run(i * (slot / 2)));
  }
  add(books, piconet.run(30 * second));
  EXPECT_GT(of(books, DeliveryOutcome::delivered), 20);
  EXPECT_GT(of(books, DeliveryOutcome::no_link), 20);
  EXPECT_EQ(std::accumulate(books.begin() + 1, books.end(), 0.0), of(books, DeliveryOutcome::under_way));
}

TEST(Queue, RefusesWhatItHasNoRoomFor) {
  Piconet piconet(1);
  piconet.settings.queue = 3;
  for (int i = 0; i < 10; ++i) piconet.medium.ask(0, 1, 0, "x");
  const Books books = books_of(piconet.run());
  EXPECT_EQ(of(books, DeliveryOutcome::delivered), 4);
  EXPECT_EQ(of(books, DeliveryOutcome::queue_full), 6);
}

TEST(Gone, CopiesOfWhoLeavesAreCountedAsSuch) {
  for (const std::size_t leaver : {0, 1}) {
    Piconet piconet(2);
    for (int i = 0; i < 5; ++i)
      for (const std::size_t from : {0, 1}) piconet.medium.ask(0, from, 1 - from, std::string(5000, 'x'));
    Books books = books_of(piconet.run(second / 5));
    piconet.channel.alive[leaver] = 0;
    add(books, piconet.run(second / 2));
    EXPECT_EQ(of(books, DeliveryOutcome::delivered) + of(books, DeliveryOutcome::gone), 10);
    EXPECT_GT(of(books, DeliveryOutcome::delivered), 0);
    EXPECT_GT(of(books, DeliveryOutcome::gone), 0);
    piconet.channel.alive[leaver] = 1;
    EXPECT_TRUE(piconet.run(second).deliveries.empty());
  }
}

// ---- State --------------------------------------------------------------------------------------------------------

// The division into ticks does not matter, nor does saving and loading the medium between them.
TEST(State, IsTheSameForAnyTicks) {
  std::string ends[2];
  std::vector<Time> received[2];
  for (const int ticks : {1, 37}) {
    Piconet piconet(4);
    piconet.set_ratio(milliwatts(12.5));
    piconet.settings.flush = 80 * slot;
    for (int tick = 0; tick < ticks; ++tick) {
      const Time from = tick * second / ticks, until = (tick + 1) * second / ticks;
      for (int i = 0; i < 400; ++i)
        if (const Time at = i * second / 400; at >= from && at < until)
          piconet.medium.ask(at, static_cast<std::size_t>(i) % 5, i % 3 ? Medium::everyone : (i + 1) % 5,
                             std::string(static_cast<std::size_t>(i % 300), 'x'));
      for (const Arrival& a : piconet.run(until).arrivals) received[ticks > 1].push_back(a.received);
      Medium next{Stream(7)};
      next.load(piconet.medium.save());
      piconet.medium = next;
    }
    ends[ticks > 1] = piconet.medium.save();
  }
  EXPECT_GT(received[0].size(), 100u);
  EXPECT_TRUE(received[0] == received[1]);
  EXPECT_TRUE(ends[0] == ends[1]);
}

}  // namespace
}  // namespace muster::bluetooth
