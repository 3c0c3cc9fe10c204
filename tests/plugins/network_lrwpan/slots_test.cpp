// Superframes and slotted CSMA/CA: what no frame may do, and who is silent. Rows 24 and 25 of the requirements.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numeric>

#include "medium.hpp"
#include "peers/ours.hpp"

namespace muster::lrwpan {
namespace {

using medium::Frame;
using peers::add;
using peers::Books;
using peers::of;

constexpr Time second = 1'000'000'000;
constexpr Time base = 15'360'000;   // ns: 960 symbols
constexpr Time period = 320'000;    // ns: 20 symbols
constexpr Time beacon = 608'000;    // ns: 19 octets
constexpr Time cap_from = 640'000;  // ns: the first boundary after it
constexpr std::size_t radios = 8;

Settings in_superframes(int beacon_order, int superframe_order) {
  Settings s;
  s.noise = medium::milliwatts(-106.987);
  s.busy = medium::milliwatts(-77);
  s.queue = 1'000'000;
  s.beacon_order = beacon_order;
  s.superframe_order = superframe_order;
  return s;
}

// Radios within 12 m, all of which hear all; the first is the coordinator.
Channel room() {
  const std::vector<std::array<double, 2>> at{{0, 0}, {4, 0}, {8, 0}, {0, 4}, {4, 4}, {8, 4}, {0, 8}, {4, 8}};
  return peers::channel_of(at);
}

bool is_beacon(const Frame& f) { return f.sender == 0 && f.end - f.begin == beacon && f.begin % base == 0; }

// Runs one medium, a back-off period at a time, so that it sees each frame.
struct Watched {
  Channel channel = room();
  Settings settings;
  Medium medium;
  Time now = 0;
  Books books{};
  std::map<std::uint64_t, Frame> frames;
  std::vector<medium::Arrival> arrivals;
  std::vector<Member> counts = std::vector<Member>(radios);

  explicit Watched(const Settings& s, std::uint64_t seed = 1) : settings(s), medium(Stream(seed)) {}
  void run(Time until) {
    for (; now < until; now += period) {
      const Report& report = medium.run(now, now + period, channel, settings);
      add(books, report);
      arrivals.insert(arrivals.end(), report.arrivals.begin(), report.arrivals.end());
      for (const Frame& f : medium.frames()) frames[f.id] = f;
      for (std::size_t i = 0; i < medium.members().size(); ++i) {
        counts[i].heard += medium.members()[i].heard, counts[i].lost += medium.members()[i].lost;
        counts[i].silent += medium.members()[i].silent;
        counts[i].between_devices += medium.members()[i].between_devices;
      }
    }
  }
  // Requests of all kinds, so many a second in all: up, down, to all, in one frame or several.
  void ask(double rate, Time until) {
    const Stream random(11);
    const Time from = now;
    for (std::uint64_t i = 0;; ++i) {
      const Time at = from + static_cast<Time>(static_cast<double>(i) * 1e9 / rate);
      if (at >= until) return;
      run(at / period * period);
      const auto sender = static_cast<std::size_t>(random.uniform(i, 0) * radios);
      const auto device = 1 + static_cast<std::size_t>(random.uniform(i, 1) * (radios - 1));
      const bool is_to_all = i % 5 == 0;
      medium.ask(std::max(at, now), sender,
                 is_to_all     ? Medium::everyone
                 : sender == 0 ? device
                               : 0,
                 std::string(i % 7 == 0 ? 300 : i % 117, 'x'));
    }
  }
};

class Superframes : public testing::TestWithParam<std::tuple<int, int>> {
 protected:
  const int beacon_order = std::get<0>(GetParam()), superframe_order = std::get<1>(GetParam());
  const Time interval = base << beacon_order, active = base << superframe_order;
};
INSTANTIATE_TEST_SUITE_P(Orders, Superframes,
                         testing::Values(std::tuple{0, 0}, std::tuple{3, 3}, std::tuple{3, 0}, std::tuple{4, 2}));

TEST_P(Superframes, Row25NoFrameBeginsOffABoundaryOrOutsideOfTheCap) {
  Watched star(in_superframes(beacon_order, superframe_order));
  star.ask(200.0 * static_cast<double>(active) / static_cast<double>(interval), 20 * second);
  star.run(20 * second);
  Time beacons = 0, others = 0, latest = 0;
  for (const auto& [id, f] : star.frames) {
    const Time into = f.begin % interval;
    if (is_beacon(f)) {
      EXPECT_EQ(into, 0);
      EXPECT_EQ(f.begin, beacons++ * interval);
      continue;
    }
    ++others;
    EXPECT_EQ(f.begin % period, 0);
    EXPECT_GE(into, cap_from + (f.ack_of == medium::nothing ? 2 * period : 0));
    const Time spacing = f.end - f.begin > air_time(18) ? long_spacing : short_spacing;
    const Time room = active - into - (f.end - f.begin) - (f.ack_of == medium::nothing ? spacing : short_spacing);
    EXPECT_GE(room, 0);
    latest = std::max(latest, into);
  }
  EXPECT_EQ(beacons, (20 * second + interval - 1) / interval);
  EXPECT_GT(others, 500);
  EXPECT_GT(latest, active * 7 / 10);  // the CAP is used up to its end
}

// With two assessments a frame stays clear of an exchange: one of them lies outside of the gap before an
// acknowledgement. The threshold is so low that a frame's last octet alone is above it.
TEST_P(Superframes, Row25TheChannelIsFreeAtBothAssessments) {
  Settings settings = in_superframes(beacon_order, superframe_order);
  settings.busy = medium::milliwatts(-90);
  Watched star(settings);
  star.ask(300.0 * static_cast<double>(active) / static_cast<double>(interval), 10 * second);
  int acks = 0;
  for (auto f = star.frames.begin(); f != star.frames.end(); ++f) {
    if (f->second.ack_of != medium::nothing) {
      const Time waited = f->second.begin - star.frames[f->second.ack_of].end;
      EXPECT_GE(waited, 12 * symbol);
      EXPECT_LT(waited, 32 * symbol);
      ++acks;
      continue;
    }
    if (is_beacon(f->second)) continue;
    for (auto before = star.frames.begin(); before != f; ++before)
      for (const Time ago : {2 * period, period}) {
        const Time since = f->second.begin - ago;
        if (before->second.begin >= since + cca_window || before->second.end <= since) continue;
        ADD_FAILURE() << "frame " << f->first << " was assessed during frame " << before->first;
      }
  }
  EXPECT_GT(acks, 100);
}

TEST_P(Superframes, EachCopyHasOneFate) {
  Watched star(in_superframes(beacon_order, superframe_order));
  star.ask(150.0 * static_cast<double>(active) / static_cast<double>(interval), 5 * second);
  star.run(15 * second);
  EXPECT_EQ(std::accumulate(star.books.begin() + 1, star.books.end(), 0.0), of(star.books, DeliveryOutcome::under_way));
  EXPECT_GT(of(star.books, DeliveryOutcome::delivered), 0);
}

TEST_P(Superframes, AreTheSameForAnyTicksAndAfterARestore) {
  std::string ends[2];
  for (const int ticks : {1, 41}) {
    Medium medium{Stream(3)};
    const Channel channel = room();
    for (int tick = 0; tick < ticks; ++tick) {
      const Time from = tick * second / ticks, until = (tick + 1) * second / ticks;
      for (int i = 0; i < 100; ++i)
        if (const Time at = i * second / 100; at >= from && at < until)
          medium.ask(at, static_cast<std::size_t>(i) % radios, i % 4 ? 0 : Medium::everyone, std::string(200, 'x'));
      medium.run(from, until, channel, in_superframes(beacon_order, superframe_order));
      Medium next{Stream(3)};
      next.load(medium.save());
      medium = next;
    }
    ends[ticks > 1] = medium.save();
  }
  EXPECT_TRUE(ends[0] == ends[1]);
}

// ---- Active and inactive parts --------------------------------------------------------------------------------------

// A saturated device sends for 2^(SO - BO) of the time.
TEST(DutyCycle, Row25IsTwoToThePowerOfTheOrders) {
  const auto rate = [](int beacon_order) {
    Medium medium{Stream(2)};
    Settings s = in_superframes(beacon_order, 7);
    s.acknowledged = false;
    const Time until = 16 * (base << 9);
    for (int i = 0; i < 30'000; ++i) medium.ask(cap_from, 1, 0, std::string(83, 'x'));
    return static_cast<double>(medium.run(0, until, room(), s).arrivals.size());
  };
  const double always = rate(7);
  EXPECT_GT(always, 15'000);
  EXPECT_NEAR(rate(8) / always, 0.5, 0.005);
  EXPECT_NEAR(rate(9) / always, 0.25, 0.005);
}

// Receivers are off in the inactive part: of frames that a radio of another PAN sends at any moment, without
// superframes, those arrive that lie in the active part.
TEST(DutyCycle, Row25ReceiversAreOnForAsMuch) {
  constexpr int frames = 4000;
  const Time frame = air_time(header + sender_pan + 40), interval = base << 3;
  for (const int superframe_order : {0, 1, 2, 3}) {
    Medium medium{Stream(5)};
    Settings s = in_superframes(3, superframe_order);
    s.acknowledged = false;
    s.pans.assign(radios, 1);
    s.pans.back() = 2;
    for (int i = 0; i < frames; ++i)
      medium.ask(i * (second / 20) + std::llround(5e7 * Stream(4).uniform(static_cast<std::uint64_t>(i))), radios - 1,
                 1, std::string(40, 'x'));
    const auto arrived = static_cast<double>(medium.run(0, (frames + 1) * (second / 20), room(), s).arrivals.size());
    const bool has_inactive_part = superframe_order < 3;
    const double on = static_cast<double>((base << superframe_order) - (has_inactive_part ? frame : 0));
    const double expected = on / static_cast<double>(interval);
    const double three_sigma = 3 * std::sqrt(expected * (1 - expected) / frames);
    const double beside_beacons = static_cast<double>(beacon + frame) / static_cast<double>(interval);
    EXPECT_NEAR(arrived / frames, expected, three_sigma + beside_beacons) << superframe_order;
  }
}

// With three periods left of the CAP, counts up to three end in it and are drawn anew in the next one, for there is no
// room; counts above go on there.
TEST(Backoff, Row25StandsStillBetweenCaps) {
  constexpr int runs = 4000;
  std::map<Time, int> waited;
  for (int seed = 0; seed < runs; ++seed) {
    Medium medium{Stream(static_cast<std::uint64_t>(seed))};
    medium.ask(base - 3 * period, 1, 0, "x");
    const Report& report = medium.run(0, second, room(), in_superframes(3, 0));
    ASSERT_EQ(report.arrivals.size(), 1u);
    const Time begin = report.arrivals[0].received - air_time(header + 1) - (base << 3) - cap_from;
    ASSERT_EQ(begin % period, 0);
    ++waited[begin / period - 2];
  }
  EXPECT_EQ(waited.size(), 8u);
  for (const auto& [periods, times] : waited) {
    const double expected = periods >= 1 && periods <= 4 ? 3.0 / 16 : 1.0 / 16;
    EXPECT_NEAR(static_cast<double>(times) / runs, expected, 4 * std::sqrt(expected / runs)) << periods;
  }
}

// ---- The star -------------------------------------------------------------------------------------------------------

TEST(Star, Row24DevicesTalkToTheCoordinatorAndToNobodyElse) {
  Watched star(in_superframes(3, 3));
  star.run(period * 4);
  star.medium.ask(star.now, 1, 0, "up");
  star.medium.ask(star.now, 1, 2, "across");
  star.medium.ask(star.now, 2, Medium::everyone, "from a device to all");
  star.medium.ask(star.now, 0, 3, "down");
  star.medium.ask(star.now, 0, Medium::everyone, "from the coordinator to all");
  star.run(second);
  std::map<std::string, int> got;
  for (const auto& a : star.arrivals) ++got[a.payload];
  EXPECT_EQ(got, (std::map<std::string, int>{
                     {"up", 1}, {"from a device to all", 1}, {"down", 1}, {"from the coordinator to all", 1}}));
  EXPECT_EQ(of(star.books, DeliveryOutcome::delivered), 1 + 1 + 1 + (radios - 1.0));
  EXPECT_EQ(of(star.books, DeliveryOutcome::no_link), 1 + (radios - 2.0));
  EXPECT_EQ(star.counts[1].between_devices, 1u);
}

// Without a link from the coordinator a device is silent, and its messages are counted.
TEST(Star, Row24WhoHasHeardNoBeaconIsSilent) {
  Watched star(in_superframes(2, 1));
  star.channel.power[0 * radios + 3] = 0, star.channel.rssi[0 * radios + 3] = std::nan("");
  for (int i = 0; i < 20; ++i) star.medium.ask(star.now, 3, 0, "lost"), star.run(star.now + second / 20);
  for (const auto& [id, f] : star.frames) EXPECT_NE(f.sender, 3u);
  EXPECT_EQ(of(star.books, DeliveryOutcome::no_access), 20);
  EXPECT_EQ(star.counts[3].silent, 20u);
  EXPECT_EQ(star.counts[3].heard, 0u);
  EXPECT_EQ(star.counts[3].lost, star.counts[1].heard);
  // And not for ever.
  star.channel = room();
  star.run(star.now + 4 * base);
  star.medium.ask(star.now, 3, 0, "heard");
  star.run(star.now + second);
  ASSERT_EQ(star.arrivals.size(), 1u);
  EXPECT_EQ(star.arrivals[0].payload, "heard");
}

TEST(Star, Row24WhoLosesFourBeaconsFallsSilent) {
  Watched star(in_superframes(2, 2));
  const Time interval = base << 2;
  const auto ask_and_run = [&](Time until) {
    while (star.now < until) star.medium.ask(star.now, 3, 0, "up"), star.run(star.now + 40 * period);
  };
  ask_and_run(10 * interval + interval / 2);
  const Time cut = star.now;
  star.channel.power[0 * radios + 3] = 0, star.channel.rssi[0 * radios + 3] = std::nan("");
  ask_and_run(30 * interval);
  Time last = 0;
  for (const auto& [id, f] : star.frames)
    if (f.sender == 3) last = std::max(last, f.begin);
  EXPECT_GT(last, cut + 3 * interval);
  EXPECT_LT(last, 14 * interval + cap_from);  // the beacons 11 to 14 are the four
  EXPECT_EQ(star.counts[3].heard, 11u);
  EXPECT_EQ(star.counts[3].lost, 19u);
  EXPECT_GT(star.counts[3].silent, 50u);
  EXPECT_EQ(of(star.books, DeliveryOutcome::no_access), static_cast<double>(star.counts[3].silent));
}

TEST(Star, Row24WithoutItsCoordinatorAllFallSilent) {
  Watched star(in_superframes(1, 1));
  star.run(10 * base);
  star.channel.alive[0] = 0;
  star.run(30 * base);
  const std::size_t before = star.frames.size();
  for (std::size_t i = 1; i < radios; ++i) star.medium.ask(star.now, i, Medium::everyone, "x");
  star.run(60 * base);
  EXPECT_EQ(star.frames.size(), before);
  EXPECT_EQ(star.counts[1].silent, radios - 2);  // copies
}

// Radios of other PANs have no superframes. Those of the PAN go over to them in mid-run, and back.
TEST(Star, OrdersMayChangeInMidRun) {
  Watched star(in_superframes(no_beacons, no_beacons));
  star.ask(150, second);
  star.settings = in_superframes(2, 1);
  const Time from = star.now + 2 * (base << 2);
  star.ask(60, 3 * second);
  const Time until = star.now;
  star.settings = in_superframes(no_beacons, no_beacons);
  star.ask(100, 4 * second);
  star.run(10 * second);
  int within = 0;
  for (const auto& [id, f] : star.frames) {
    if (f.begin < from || f.begin >= until || is_beacon(f)) continue;
    EXPECT_EQ(f.begin % period, 0);
    EXPECT_LE(f.end % (base << 2), base << 1);
    ++within;
  }
  EXPECT_GT(within, 100);
  EXPECT_EQ(std::accumulate(star.books.begin() + 1, star.books.end(), 0.0), of(star.books, DeliveryOutcome::under_way));
  EXPECT_GT(star.arrivals.back().received, until);
}

// No beacon leaves a medium as it is without any: the same bytes of state.
TEST(Star, WithoutBeaconsNothingIsKeptOfThem) {
  Watched one(in_superframes(no_beacons, no_beacons)), other(in_superframes(no_beacons, no_beacons));
  other.settings.coordinator = 5;
  one.ask(100, second), other.ask(100, second);
  EXPECT_TRUE(one.medium.save() == other.medium.save());
  EXPECT_TRUE(one.medium.members().empty());
}

// A beacon of 13 octets, or 19 with an extended address.
TEST(Row24, BeaconsHaveTheirTimeOnTheAir) {
  EXPECT_EQ(air_time(beacon_frame(false)), beacon);
  EXPECT_EQ(air_time(beacon_frame(true)), beacon + 6 * octet);
  EXPECT_EQ(base_superframe, base);
  EXPECT_EQ(unit_backoff, period);
}

}  // namespace
}  // namespace muster::lrwpan
