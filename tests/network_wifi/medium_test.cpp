// The medium against the standard's times, Bianchi's closed form and its own books.
#include "medium.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "peers/ours.hpp"

namespace muster::wifi {
namespace {

using packets::Arrival;
using packets::milliwatts;
using packets::never;
using peers::add;
using peers::Books;
using peers::channel_of;
using peers::of;

constexpr Time second = 1'000'000'000;

Settings settings(int mbit = 6) {
  Settings s;
  s.noise = milliwatts(-93.966);
  s.busy = milliwatts(-62);
  s.rate = rate_of(mbit);
  s.queue = 1'000'000;
  return s;
}

// Radios at 16 dBm.
struct Cell {
  explicit Cell(const std::vector<std::array<double, 2>>& at, uint64_t seed = 7)
      : channel(channel_of(at, 16, -82)), medium{Stream(seed)} {}
  // `one` and `other` do not hear each other.
  void hide(std::size_t one, std::size_t other) {
    for (const std::size_t link : {one * channel.radios + other, other * channel.radios + one})
      channel.power[link] = 0, channel.rssi[link] = std::nan("");
  }
  Report run(const Settings& s, Time until = second) { return medium.run(0, until, channel, s); }

  Channel channel;
  Medium medium;
};

// ---- Times --------------------------------------------------------------------------------------------------------

TEST(AirTime, IsTheStandards) {
  // 802.11-2016, 18.4.3: 20 us, symbols of 4 us, 6 us.
  EXPECT_EQ(air_time(14, rates[rate_of(6)]), (20 + 24 + 6) * microsecond);      // an ACK: 134 bits, 6 symbols
  EXPECT_EQ(air_time(14, rates[rate_of(24)]), (20 + 8 + 6) * microsecond);      // 2 symbols
  EXPECT_EQ(air_time(1536, rates[rate_of(54)]), (20 + 228 + 6) * microsecond);  // 12310 bits in 57 symbols of 216
  EXPECT_EQ(air_time(76, rates[rate_of(6)]), (20 + 108 + 6) * microsecond);     // 630 bits in 27
}

// Row 24 of the requirements: 6 to 54 Mbit/s; three addresses of 48 bits between control, duration and sequence number,
// then LLC, SNAP and the check sequence; 2304 octets of payload with LLC and SNAP, pieces beyond.
TEST(Row24, TheModeSetsRatesAddressesAndPieces) {
  for (const Rate& rate : rates) {
    const auto bits = static_cast<double>(8 * 1'000'000);
    EXPECT_NEAR(1e3 * bits / static_cast<double>(air_time(1'000'000, rate)), rate.mbit, 1e-3 * rate.mbit);
  }
  EXPECT_EQ(header, 2u + 2 + 3 * 6 + 2 + 8 + 4);
  EXPECT_EQ(frames_of(2304 - 8), 1u);
  EXPECT_EQ(frames_of(2304 - 7), 2u);
}

TEST(Access, AtAnIdleChannelIsImmediate) {
  Cell cell({{0, 0}, {3, 0}});
  cell.medium.ask(second / 2, 0, Medium::everyone, std::string(40, 'x'));
  const auto arrivals = cell.run(settings()).arrivals;
  ASSERT_EQ(arrivals.size(), 1u);
  EXPECT_EQ(arrivals[0].received, second / 2 + air_time(header + 40, rates[0]));
}

// After a frame of its own a station waits DIFS and 0 to 15 slots, each as often.
TEST(Access, AfterAFrameSlotsAreCounted) {
  for (const Time slot : {long_slot, short_slot}) {
    Settings s = settings();
    s.slot = slot;
    std::array<int, least_window + 1> seen{};
    Cell cell({{0, 0}, {3, 0}});
    for (int i = 0; i < 1000; ++i) cell.medium.ask(0, 0, Medium::everyone, "");
    const auto arrivals = cell.run(s).arrivals;
    ASSERT_EQ(arrivals.size(), 1000u);
    for (std::size_t i = 1; i < arrivals.size(); ++i) {
      const Time waited =
          arrivals[i].received - arrivals[i - 1].received - air_time(header, rates[0]) - sifs - 2 * slot;
      ASSERT_EQ(waited % slot, 0);
      ASSERT_LT(waited / slot, 16);
      ++seen[static_cast<std::size_t>(waited / slot)];
    }
    for (const int count : seen) EXPECT_NEAR(count, 62.5, 5 * std::sqrt(62.5));
  }
}

// A frame and its acknowledgement are one exchange, after which others count as after any frame.
TEST(Access, WaitsForAnExchangeOfOthersToEnd) {
  Time least = second;
  for (uint64_t seed = 0; seed < 200; ++seed) {
    Cell cell({{0, 0}, {3, 0}, {0, 3}}, seed);
    cell.medium.ask(0, 0, 1, std::string(1000, 'x'));
    cell.medium.ask(100 * microsecond, 2, Medium::everyone, "");
    const auto arrivals = cell.run(settings()).arrivals;
    ASSERT_EQ(arrivals.size(), 2u);
    least = std::min(least, arrivals[1].received - arrivals[0].received);
  }
  const Time exchange = sifs + ack_time(rates[0]), frame = air_time(header, rates[0]);
  EXPECT_EQ(least, exchange + sifs + 2 * long_slot + frame);
}

// The same where the acknowledgement itself is not heard: the frame said how long to keep silent.
TEST(Access, KeepsSilentForAnAcknowledgementThatItDoesNotHear) {
  for (uint64_t seed = 0; seed < 50; ++seed) {
    Cell cell({{0, 0}, {3, 0}, {0, 3}}, seed);
    cell.hide(1, 2);
    cell.medium.ask(0, 0, 1, std::string(1000, 'x'));
    cell.medium.ask(100 * microsecond, 2, 0, "");
    const auto arrivals = cell.run(settings()).arrivals;
    ASSERT_EQ(arrivals.size(), 2u);
    EXPECT_GE(arrivals[1].received - arrivals[0].received,
              sifs + ack_time(rates[0]) + sifs + 2 * long_slot + air_time(header, rates[0]));
  }
}

// A station that heard a frame come wrong leaves time for an acknowledgement that it might not hear.
TEST(Access, WaitsLongerAfterAFrameThatCameWrong) {
  Time least = second;
  for (uint64_t seed = 0; seed < 200; ++seed) {
    Cell cell({{0, 0}, {3, 0}, {1.5, 2.6}}, seed);
    // Two that do not hear each other talk over one another at the third, which has something to say, too.
    cell.hide(0, 1);
    cell.medium.ask(0, 0, Medium::everyone, std::string(1000, 'x'));
    cell.medium.ask(500 * microsecond, 1, Medium::everyone, std::string(200, 'x'));
    cell.medium.ask(600 * microsecond, 2, Medium::everyone, "");
    const auto arrivals = cell.run(settings()).arrivals;
    ASSERT_EQ(arrivals.size(), 1u);
    least = std::min(least, arrivals[0].received);
  }
  const Time wrong_until = air_time(header + 1000, rates[0]), frame = air_time(header, rates[0]);
  EXPECT_EQ(least, wrong_until + sifs + air_time(ack_frame, rates[0]) + sifs + 2 * long_slot + frame);
}

// ---- Messages -----------------------------------------------------------------------------------------------------

TEST(Payload, ArrivesByteForByteInAsManyPiecesAsItNeeds) {
  EXPECT_EQ(frames_of(0), 1u);
  EXPECT_EQ(frames_of(2296), 1u);
  EXPECT_EQ(frames_of(2297), 2u);
  for (const std::size_t size : {0, 1, 2296, 2297, 50000}) {
    for (const std::size_t to : {std::size_t{1}, Medium::everyone}) {
      Cell cell({{0, 0}, {3, 0}});
      std::string payload(size, '\0');
      for (std::size_t i = 0; i < size; ++i) payload[i] = static_cast<char>(mixed(i));
      cell.medium.ask(0, 0, to, payload);
      const Report report = cell.run(settings());
      ASSERT_EQ(report.deliveries.size(), 1u) << size;
      EXPECT_TRUE(report.arrivals[0].payload == payload) << size;
      EXPECT_GE(report.arrivals[0].received, static_cast<Time>(8000 * size / 6));
    }
  }
}

// Where a quarter of the frames is lost in noise, seven tries get all but a few through, and none arrives twice.
TEST(Acknowledgement, LostFramesAreSentAgain) {
  double distance = 20;
  const auto lost = [&](int retries) {
    Settings s = settings(54);
    s.retries = retries;
    Books books{};
    Cell cell({{0, 0}, {distance, 0}});
    cell.channel.rssi.assign(4, -70);  // heard in any case
    for (int i = 0; i < 2000; ++i) cell.medium.ask(i * second / 200, 0, 1, std::string(500, 'x'));
    add(books, cell.run(s, 20 * second));
    EXPECT_EQ(of(books, Fate::delivered) + of(books, Fate::too_weak) + of(books, Fate::no_ack), 2000);
    return of(books, Fate::too_weak) / 2000;
  };
  while (lost(0) < 0.25) distance += 0.5;
  EXPECT_LT(lost(0), 0.5);
  EXPECT_NEAR(lost(1), std::pow(lost(0), 2), 0.03);
  EXPECT_LT(lost(6), 0.005);
}

TEST(Acknowledgement, NotHeardItEndsAMessageOfSeveralFrames) {
  for (const std::size_t size : {std::size_t{40}, std::size_t{5000}}) {
    Cell cell({{0, 0}, {3, 0}});
    cell.channel.power[1 * 2 + 0] = 0;
    cell.channel.rssi[1 * 2 + 0] = std::nan("");
    cell.medium.ask(0, 0, 1, std::string(size, 'x'));
    Books books{};
    const Report report = cell.run(settings());
    add(books, report);
    EXPECT_EQ(report.deliveries.size(), size == 40 ? 1u : 0u);  // once, though it is sent seven times
    EXPECT_EQ(of(books, size == 40 ? Fate::delivered : Fate::no_ack), 1);
  }
}

TEST(Books, EachCopyHasOneFate) {
  const peers::Task task = peers::crowd(3, 20, 20, 400, 1);
  Cell cell(task.places);
  for (const peers::Request& r : task.requests)
    cell.medium.ask(std::llround(r.at * second), r.from, r.from % 2 ? Medium::everyone : (r.from + 1) % 20,
                    std::string(40, 'x'));
  Settings s = settings();
  s.queue = 10;
  Books books{};
  add(books, cell.run(s, 3 * second));
  EXPECT_EQ(std::accumulate(books.begin() + 1, books.end(), 0.0), of(books, Fate::under_way));
  EXPECT_GT(of(books, Fate::collided), 0);
  EXPECT_GT(of(books, Fate::queue_full), 0);
}

// ---- Contention ---------------------------------------------------------------------------------------------------

// Bianchi, Performance analysis of the IEEE 802.11 distributed coordination function (2000): throughput of n stations
// that always have something to send, as a share of the time. A busy slot is an exchange, or a collision with what
// others wait after it: DIFS, as he has it, or EIFS where they took up one of its frames, which came wrong.
Time difs(const Settings& s) { return sifs + 2 * s.slot; }
Time eifs(const Settings& s) { return sifs + air_time(ack_frame, rates[0]) + difs(s); }
double bianchi(double n, std::size_t payload, const Settings& s, Time after_collision) {
  const double windows = least_window + 1, stages = std::log2((most_window + 1) / windows);
  double tau = 0.1, p = 0;
  for (int i = 0; i < 10000; ++i) {
    p = 1 - std::pow(1 - tau, n - 1);
    const double next = 2 * (1 - 2 * p) / ((1 - 2 * p) * (windows + 1) + p * windows * (1 - std::pow(2 * p, stages)));
    tau += 0.05 * (next - tau);
  }
  const double some = 1 - std::pow(1 - tau, n), one = n * tau * std::pow(1 - tau, n - 1) / some;
  const auto frame = static_cast<double>(air_time(header + payload, rates[s.rate]));
  const auto ack = static_cast<double>(sifs + ack_time(rates[s.rate]));
  const double good = frame + ack + static_cast<double>(difs(s)), bad = frame + static_cast<double>(after_collision);
  const double data = 8e3 * static_cast<double>(payload) / rates[s.rate].mbit;  // ns
  return some * one * data / ((1 - some) * static_cast<double>(s.slot) + some * one * good + some * (1 - one) * bad);
}

// The first of the stations receives what all others always have to send.
double saturated(Cell& cell, int mbit, std::size_t payload, const Settings& s) {
  constexpr int ticks = 100;
  const auto senders = static_cast<int>(cell.channel.radios) - 1;
  double bits = 0;
  for (int tick = 0; tick < ticks; ++tick) {
    for (int i = 1; i <= senders; ++i)
      for (int k = 0; k < 30 * mbit / senders; ++k)
        cell.medium.ask(tick * second / 10, static_cast<std::size_t>(i), 0, std::string(payload, 'x'));
    const auto& report = cell.medium.run(tick * second / 10, (tick + 1) * second / 10, cell.channel, s);
    bits += 8.0 * static_cast<double>(payload * report.arrivals.size());
  }
  return bits / (1e5 * mbit * ticks);
}

class Saturated : public testing::TestWithParam<std::tuple<int, int>> {
 protected:
  static constexpr std::size_t payload = 1500;
  const int n = std::get<0>(GetParam()), mbit = std::get<1>(GetParam());
  Settings s = [this] {
    Settings result = settings(mbit);
    result.retries = 255;  // as in the closed form
    result.queue = 300;    // more than one sends in a tick
    return result;
  }();
  // Stations around the receiver, so that none is captured there.
  Cell around() const {
    std::vector<std::array<double, 2>> at{{0, 0}};
    for (int i = 0; i < n; ++i) at.push_back({2 * std::cos(2 * M_PI * i / n), 2 * std::sin(2 * M_PI * i / n)});
    return Cell(at);
  }
  void expect_near(double got, double expected, double tolerance) const {
    std::printf("%d stations at %d Mbit/s: %.4f (%.4f), %+.1f %%\n", n, mbit, got, expected,
                100 * (got / expected - 1));
    EXPECT_NEAR(got, expected, tolerance * expected);
  }
};
INSTANTIATE_TEST_SUITE_P(Stations, Saturated,
                         testing::Combine(testing::Values(2, 5, 10, 20, 30, 50), testing::Values(6, 54)));

// Row 25 of the requirements. In his conditions: all hear all equally strongly, so that of a collision nobody hears
// more than that the channel was busy.
TEST_P(Saturated, ThroughputIsBianchis) {
  Cell cell = around();
  for (std::size_t from = 0; from < cell.channel.radios; ++from)
    for (std::size_t to = 0; to < cell.channel.radios; ++to)
      if (from != to) {
        cell.channel.power[from * cell.channel.radios + to] = milliwatts(-40);
        cell.channel.rssi[from * cell.channel.radios + to] = -40;
      }
  expect_near(saturated(cell, mbit, payload, s), bianchi(n, payload, s, difs(s)), 0.05);
}

// Neighbours take up one of two frames that collide, and wait longer after it.
TEST_P(Saturated, ThroughputIsNearlyHisWhereNeighboursCapture) {
  Cell cell = around();
  expect_near(saturated(cell, mbit, payload, s), bianchi(n, payload, s, eifs(s)), n > 30 ? 0.06 : 0.05);
}

// Two that do not hear each other talk over one another at the one between them, whose loss is what chance says: a
// frame begins during another, or another during it. Acknowledgements and retries get most of it through.
// Row 25 of the requirements.
TEST(HiddenTerminals, Collide) {
  const auto lost = [](bool hidden, bool acknowledged) {
    Cell cell({{0, 0}, {20, 0}, {40, 0}});
    if (hidden) cell.hide(0, 2);
    Settings s = settings();
    s.acknowledged = acknowledged;
    for (int i = 0; i < 2000; ++i)
      for (const std::size_t from : {0, 2})
        cell.medium.ask(i * second / 100 + std::llround(1e7 * Stream(9).uniform(static_cast<uint64_t>(i), from)), from,
                        1, std::string(600, 'x'));
    Books books{};
    add(books, cell.run(s, 21 * second));
    return of(books, Fate::collided) / of(books, Fate::under_way);
  };
  EXPECT_LT(lost(false, false), 0.01);
  const double frame = 1e-9 * static_cast<double>(air_time(header + 600, rates[0]));
  EXPECT_NEAR(lost(true, false), 2 * frame / 0.01, 0.02);
  EXPECT_LT(lost(true, true), 0.01);
}

// Begun together, the near one gets through and the far one does not, whichever begins first within the 4 us of
// detection.
TEST(NearAndFar, TheNearOneIsTakenUp) {
  for (const Time later : {Time{0}, 3 * microsecond, -3 * microsecond}) {
    Cell cell({{0, 0}, {2, 0}, {20, 0}});
    cell.hide(0, 2);
    cell.medium.ask(second / 2, 0, 1, std::string(100, 'x'));
    cell.medium.ask(second / 2 + later, 2, 1, std::string(100, 'x'));
    Settings s = settings();
    s.acknowledged = false;
    const auto arrivals = cell.run(s).arrivals;
    ASSERT_EQ(arrivals.size(), 1u) << later;
    EXPECT_EQ(arrivals[0].from, 0u);
  }
}

// At 6 Mbit/s bits come right at 3.6 dB, but no preamble is found.
TEST(NearAndFar, OfTwoThatAreAboutAsStrongNoneIsTakenUp) {
  Cell cell({{0, 0}, {2, 0}, {2 + 2 * std::pow(10, 0.12), 0}});
  cell.hide(0, 2);
  for (const std::size_t from : {0, 2}) cell.medium.ask(second / 2, from, 1, "x");
  Settings s = settings();
  s.acknowledged = false;
  EXPECT_TRUE(cell.run(s).arrivals.empty());
}

// Later than that a frame is kept, and drowned by the near one.
TEST(NearAndFar, ALaterOneDrownsWhatIsHeard) {
  Cell cell({{0, 0}, {2, 0}, {20, 0}});
  cell.hide(0, 2);
  cell.medium.ask(second / 2, 2, 1, std::string(100, 'x'));
  cell.medium.ask(second / 2 + 5 * microsecond, 0, 1, std::string(100, 'x'));
  Settings s = settings();
  s.acknowledged = false;
  EXPECT_TRUE(cell.run(s).arrivals.empty());
}

// ---- State --------------------------------------------------------------------------------------------------------

void ask_some(Medium& medium, int from, int until) {
  for (int i = from; i < until; ++i)
    medium.ask(i * second / 2000, static_cast<std::size_t>(i) % 5, i % 3 ? Medium::everyone : (i + 1) % 5,
               std::string(static_cast<std::size_t>(7 * i % 3000), 'x'));
}
const std::vector<std::array<double, 2>> five{{0, 0}, {5, 0}, {0, 5}, {5, 5}, {9, 9}};

TEST(State, TheSameBytesMakeTheSameFuture) {
  Cell straight(five), broken(five);
  std::vector<Time> one, other;
  const auto run = [&](Cell& cell, std::vector<Time>& out, int tick) {
    ask_some(cell.medium, 20 * tick, 20 * (tick + 1));
    const auto& report = cell.medium.run(tick * second / 100, (tick + 1) * second / 100, cell.channel, settings());
    for (const Arrival& a : report.arrivals) out.push_back(a.received);
  };
  for (int tick = 0; tick < 40; ++tick) {
    run(straight, one, tick);
    run(broken, other, tick);
    Medium next{Stream(7)};
    next.load(broken.medium.save());
    broken.medium = next;
  }
  EXPECT_GT(one.size(), 100u);
  EXPECT_EQ(one, other);
  EXPECT_EQ(straight.medium.save(), broken.medium.save());
}

// Where ticks are cut does not show.
TEST(State, IsTheSameForAnyTicks) {
  std::string ends[2];
  for (const int ticks : {1, 37}) {
    Cell cell(five);
    for (int tick = 0; tick < ticks; ++tick) {
      const Time from = tick * second / ticks, until = (tick + 1) * second / ticks;
      for (int i = 0; i < 2000; ++i)
        if (const Time at = i * second / 2000; at >= from && at < until) ask_some(cell.medium, i, i + 1);
      cell.medium.run(from, until, cell.channel, settings());
    }
    ends[ticks > 1] = cell.medium.save();
  }
  EXPECT_EQ(ends[0], ends[1]);
}

TEST(Gone, CopiesOfWhoLeavesAreCountedAsSuch) {
  Cell cell({{0, 0}, {3, 0}});
  for (int i = 0; i < 5; ++i) cell.medium.ask(0, 0, 1, std::string(10000, 'x'));
  Books books{};
  add(books, cell.medium.run(0, second / 100, cell.channel, settings()));
  cell.channel.alive[0] = 0;
  add(books, cell.medium.run(second / 100, second, cell.channel, settings()));
  EXPECT_EQ(of(books, Fate::gone), 5 - of(books, Fate::delivered));
  EXPECT_GT(of(books, Fate::gone), 0);
  cell.channel.alive[0] = 1;
  EXPECT_TRUE(cell.medium.run(second, 2 * second, cell.channel, settings()).deliveries.empty());
}

}  // namespace
}  // namespace muster::wifi
