// Several personal area networks on one channel: their receivers, their mutual interference, and invariances. Row 24 of
// the requirements.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "medium.hpp"
#include "peers/ours.hpp"

namespace muster::lrwpan {
namespace {

using medium::milliwatts;
using peers::add;
using peers::Books;
using peers::of;

constexpr Time second = 1'000'000'000;
using Pans = std::vector<std::uint16_t>;

Settings in(const Pans& pans) {
  Settings s;
  s.noise = milliwatts(-106.987);
  s.busy = milliwatts(-77);
  s.queue = 1'000'000;
  s.pans = pans;
  return s;
}

// An arrival: receiver, sender, time and quality, in the order of arrivals.
struct Got {
  std::size_t from, to;
  Time sent, received;
  double rssi, ratio;
  bool operator==(const Got& b) const {
    return from == b.from && to == b.to && sent == b.sent && received == b.received && rssi == b.rssi &&
           ratio == b.ratio;
  }
};

struct Outcome {
  Books books{};
  std::vector<Got> got;
  std::string state;

  void add(const Report& report) {
    peers::add(books, report);
    for (const medium::Delivery& d : report.deliveries) {
      const medium::Arrival& a = report.arrivals[d.arrival];
      got.push_back({a.from, d.to, a.sent, a.received, d.rssi, d.ratio});
    }
  }
};

// Radios in a square of 20 m that send 40 bytes so often a second, to all and, every other message, to one.
Outcome crowd(const Settings& settings, double rate, bool to_one) {
  const std::size_t radios = settings.pans.empty() ? 8 : settings.pans.size();
  const peers::Task task = peers::crowd(5, radios, 20, rate, 4);
  const Channel channel = peers::channel_of(task.places);
  Medium medium{Stream(5)};
  Outcome run;
  std::size_t sent = 0;
  for (Time tick = 0; tick < 60; ++tick) {
    const Time since = tick * (second / 10), until = since + second / 10;
    for (const peers::Request& r : task.requests) {
      const Time at = std::llround(r.at * second);
      if (at < since || at >= until) continue;
      const std::size_t to = to_one && ++sent % 2 ? (r.from + 1 + sent % (radios - 1)) % radios : Medium::everyone;
      medium.ask(at, r.from, to, std::string(40, 'x'));
    }
    run.add(medium.run(since, until, channel, settings));
  }
  run.state = medium.save();
  return run;
}

const Pans four_and_four{1, 1, 1, 1, 2, 2, 2, 2};

TEST(Pan, WhatIsForAllIsTakenInTheSendersOwnAndNowhereElse) {
  const Pans pans{7, 7, 9, 9, 9};
  const Channel channel = peers::channel_of({{0, 0}, {3, 0}, {0, 3}, {3, 3}, {6, 0}});
  for (std::size_t from = 0; from < pans.size(); ++from) {
    Medium medium{Stream(1)};
    medium.ask(0, from, Medium::everyone, "to all");
    const Report& report = medium.run(0, second, channel, in(pans));
    std::vector<std::size_t> takers;
    for (const medium::Delivery& d : report.deliveries) takers.push_back(d.to);
    std::vector<std::size_t> mates;
    for (std::size_t i = 0; i < pans.size(); ++i)
      if (i != from && pans[i] == pans[from]) mates.push_back(i);
    EXPECT_EQ(takers, mates);
    Books books{};
    add(books, report);
    EXPECT_EQ(of(books, Fate::under_way), pans.size() - 1);
    EXPECT_EQ(of(books, Fate::no_link), pans.size() - 1 - mates.size());
  }
}

// Every frame occupies the channel at the same time and as long as in one PAN, and is received as well: the same
// messages arrive, except those between PANs.
TEST(Pan, TakesFromWhatIsHeardWhatIsOfOthersAndChangesNothingElse) {
  std::vector<Got> within;
  for (const Got& each : crowd(in({}), 40, false).got)
    if (four_and_four[each.from] == four_and_four[each.to]) within.push_back(each);
  const Outcome several = crowd(in(four_and_four), 40, false);
  EXPECT_TRUE(several.got == within);
  EXPECT_GT(within.size(), 2000u);
  EXPECT_GT(of(several.books, Fate::collided), 100);
}

TEST(Pan, ItsNumberDoesNotMatter) {
  const Outcome some = crowd(in(four_and_four), 40, true);
  const Outcome others = crowd(in({0xFFFE, 0xFFFE, 0xFFFE, 0xFFFE, 0, 0, 0, 0}), 40, true);
  EXPECT_TRUE(some.got == others.got);
  EXPECT_EQ(some.books, others.books);
  EXPECT_EQ(some.state, others.state);
}

TEST(Pan, OneForAllIsAsNone) {
  const Outcome none = crowd(in({}), 40, true), one = crowd(in(Pans(8, 3)), 40, true);
  EXPECT_TRUE(none.got == one.got);
  EXPECT_EQ(none.books, one.books);
  EXPECT_EQ(none.state, one.state);
}

TEST(Pan, EachCopyHasOneFate) {
  for (const double rate : {5.0, 40.0, 80.0}) {
    const Outcome run = crowd(in(four_and_four), rate, true);
    EXPECT_EQ(std::accumulate(run.books.begin() + 1, run.books.end(), 0.0), of(run.books, Fate::under_way)) << rate;
    EXPECT_EQ(of(run.books, Fate::delivered), static_cast<double>(run.got.size())) << rate;
  }
}

// Messages a second at the second and the fourth radio when the first, or the third too, always has broadcasts to send.
std::vector<double> rates(const Pans& pans, bool both_send) {
  constexpr int seconds = 200;
  const Channel channel = peers::channel_of({{0, 0}, {3, 0}, {3, 3}, {0, 3}});  // at equal distances
  Medium medium{Stream(2)};
  for (int i = 0; i < 180 * seconds; ++i)
    for (const std::size_t from : {0, 2})
      if (from == 0 || both_send) medium.ask(0, from, Medium::everyone, std::string(100, 'x'));
  Outcome run;
  run.add(medium.run(0, seconds * second, channel, in(pans)));
  std::vector<double> result(4);
  for (const Got& each : run.got) result[each.to] += 1.0 / seconds;
  return result;
}

// A saturated PAN alone is limited by back-off, assessment, turnaround, frame and spacing; two have half of that each,
// and a little more, for they wait at the same time.
TEST(Pan, TheChannelIsShared) {
  const double cycle = 3.5 * unit_backoff + cca_window + turnaround + air_time(header + 100) + long_spacing;
  const double alone = rates({1, 1, 2, 2}, false)[1];
  EXPECT_NEAR(alone * cycle / second, 1, 0.01);
  const std::vector<double> shared = rates({1, 1, 2, 2}, true);
  EXPECT_NEAR(shared[3] / shared[1], 1, 0.04);
  EXPECT_GT((shared[1] + shared[3]) / alone, 1);
  EXPECT_LT((shared[1] + shared[3]) / alone, 1.12);
}

// A receiver locked on a frame of another PAN does not detect one of its own: a sender of each, hidden from each other,
// and a receiver between them. Frames last 1.824 ms; each sender begins one in every 10 ms.
TEST(Pan, AReceiverIsBusyWithWhatIsNotForIt) {
  const auto lost = [](bool other_sends) {
    Channel channel = peers::channel_of({{0, 0}, {20, 0}, {40, 0}});
    for (const std::size_t link : {0 * 3 + 2, 2 * 3 + 0}) channel.power[link] = 0, channel.rssi[link] = std::nan("");
    Medium medium(Stream(5));
    for (int i = 0; i < 2000; ++i)
      for (const std::size_t from : {0, 2})
        if (from == 0 || other_sends)
          medium.ask(i * second / 100 + std::llround(1e7 * Stream(9).uniform(static_cast<uint64_t>(i), from)), from,
                     from == 0 ? 1 : Medium::everyone, std::string(40, 'x'));
    Settings settings = in({1, 1, 2});
    settings.acknowledged = false;
    const Report& report = medium.run(0, 21 * second, channel, settings);
    return static_cast<double>(report.fates[0][static_cast<std::size_t>(Fate::collided)]) / 2000;
  };
  EXPECT_EQ(lost(false), 0);
  EXPECT_NEAR(lost(true), 1.824 / 10, 0.02);
}

// ---- From one PAN to another ----------------------------------------------------------------------------------------

// Both PANs' identifiers instead of one.
TEST(InterPan, HeadersAreTwoOctetsLonger) {
  EXPECT_EQ(header + sender_pan, 2u + 1 + 2 + 2 + 2 + 2 + 2);
  EXPECT_EQ(extended_header + sender_pan, 2u + 1 + 2 + 8 + 2 + 8 + 2);
  EXPECT_EQ(frame_size(114, 0, header + sender_pan), largest_frame);
  EXPECT_EQ(frame_size(102, 0, extended_header + sender_pan), largest_frame);
}

// Time of arrival of one message from the first to the second radio, byte for byte; 0: it has not arrived.
Time arrival(std::size_t size, bool extended, const Pans& pans) {
  Settings settings = in(pans);
  settings.extended = extended;
  Medium medium{Stream(7)};
  std::string payload(size, '\0');
  for (std::size_t i = 0; i < size; ++i) payload[i] = static_cast<char>(mixed(i));
  medium.ask(0, 0, 1, payload);
  const Channel channel = peers::channel_of({{0, 0}, {3, 0}});
  const Report& report = medium.run(0, second, channel, settings);
  if (report.deliveries.size() != 1 || report.arrivals[0].payload != payload) return 0;
  return report.arrivals[0].received;
}

TEST(InterPan, AMessageToOneArrivesAndItsFrameTakesSoMuchLonger) {
  for (const bool extended : {false, true}) {
    const Time within = arrival(60, extended, {4, 4}), across = arrival(60, extended, {4, 5});
    ASSERT_GT(within, 0);
    EXPECT_EQ(across - within, 2 * octet);
  }
}

// A payload that fills a frame within a PAN needs two beyond it.
TEST(InterPan, FragmentsAreCutByTheLongerHeader) {
  for (const bool extended : {false, true}) {
    const std::size_t most = in_one_frame((extended ? extended_header : header) + sender_pan);
    EXPECT_EQ(most, extended ? 102u : 114u);
    const auto difference = [&](std::size_t size) {
      return arrival(size, extended, {4, 5}) - arrival(size, extended, {4, 4});
    };
    EXPECT_EQ(difference(most), 2 * octet);
    EXPECT_GT(difference(most + 1), long_spacing + cca_window + turnaround);
    EXPECT_GT(difference(most + 2), long_spacing + cca_window + turnaround);
    EXPECT_GT(arrival(5000, extended, {4, 5}), 0);
  }
}

// So the next one follows at once, and not after three more tries.
TEST(InterPan, IsAcknowledged) {
  const Channel channel = peers::channel_of({{0, 0}, {3, 0}});
  for (uint64_t seed = 0; seed < 20; ++seed) {
    Medium medium{Stream(seed)};
    for (int i = 0; i < 2; ++i) medium.ask(0, 0, 1, std::string(60, 'x'));
    const auto& arrivals = medium.run(0, second, channel, in({4, 5})).arrivals;
    ASSERT_EQ(arrivals.size(), 2u);
    EXPECT_LE(arrivals[1].received - arrivals[0].received,
              long_spacing + 7 * unit_backoff + cca_window + turnaround + air_time(header + sender_pan + 60));
  }
}

// ---- Changes of PAN -------------------------------------------------------------------------------------------------

TEST(Pan, WhoGoesOverTakesWhatIsTheNewOnes) {
  const Channel channel = peers::channel_of({{0, 0}, {3, 0}, {0, 3}});
  Medium medium{Stream(1)};
  const auto takers = [&](Time tick, const Pans& pans) {
    medium.ask(tick * second, 0, Medium::everyone, "to all");
    std::vector<std::size_t> result;
    for (const medium::Delivery& d : medium.run(tick * second, (tick + 1) * second, channel, in(pans)).deliveries)
      result.push_back(d.to);
    return result;
  };
  EXPECT_EQ(takers(0, {1, 1, 2}), std::vector<std::size_t>{1});
  EXPECT_EQ(takers(1, {1, 2, 1}), std::vector<std::size_t>{2});
  EXPECT_EQ(takers(2, {2, 2, 1}), std::vector<std::size_t>{1});
}

TEST(Pan, WhoLeftIsGoneFromWhichever) {
  Channel channel = peers::channel_of({{0, 0}, {3, 0}, {0, 3}});
  Medium medium{Stream(1)};
  Books books{};
  medium.ask(0, 0, Medium::everyone, "to all");
  add(books, medium.run(0, cca_window, channel, in({1, 1, 2})));
  channel.alive = {1, 0, 0};
  std::fill(channel.power.begin(), channel.power.end(), 0);
  add(books, medium.run(cca_window, second, channel, in({1, 1, 2})));
  EXPECT_EQ(of(books, Fate::gone), 2);
}

}  // namespace
}  // namespace muster::lrwpan
