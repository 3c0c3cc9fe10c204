// The medium against the standard's times and its own counts.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "cell.hpp"

namespace muster::wifi {
namespace {

using medium::Arrival;
using peers::add;
using peers::Books;
using peers::of;

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

// After a frame of its own a station waits DIFS and 0 to 15 slots, uniformly.
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

// The same without reception of the acknowledgement itself: the frame's duration field reserves the time.
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

// A station that received a faulty frame leaves time for an acknowledgement that it might not receive.
TEST(Access, WaitsLongerAfterAFrameThatCameWrong) {
  Time least = second;
  for (uint64_t seed = 0; seed < 200; ++seed) {
    Cell cell({{0, 0}, {3, 0}, {1.5, 2.6}}, seed);
    // Two hidden terminals collide at the third, which has a message, too.
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

// Where a quarter of the frames is lost in noise, seven tries deliver all but a few, and none arrives twice.
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

// The division into ticks does not matter.
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
