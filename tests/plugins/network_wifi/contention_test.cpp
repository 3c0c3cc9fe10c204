// Stations that contend, against Bianchi's closed form and probability. Row 25 of the requirements.
#include <gtest/gtest.h>

#include <cmath>

#include "cell.hpp"

namespace muster::wifi {
namespace {

using medium::milliwatts;
using peers::add;
using peers::Books;
using peers::of;

// Bianchi, Performance analysis of the IEEE 802.11 distributed coordination function (2000): throughput of n saturated
// stations, as a share of the time. A busy slot is an exchange, or a collision with the others' wait after it: DIFS, as
// in the paper, or EIFS where they locked on one of its frames, which was then faulty.
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

// The first of the stations receives from all others, which are saturated.
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

// Row 25 of the requirements. Under the paper's conditions: all receive all at equal power, so a collision appears only
// as a busy channel.
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

// Neighbours lock on one of two frames that collide, and wait longer after it.
TEST_P(Saturated, ThroughputIsNearlyHisWhereNeighboursCapture) {
  Cell cell = around();
  expect_near(saturated(cell, mbit, payload, s), bianchi(n, payload, s, eifs(s)), n > 30 ? 0.06 : 0.05);
}

// Two hidden terminals collide at the radio between them, with the loss given by probability: a frame begins during
// another, or another during it. Acknowledgements and retries deliver most of them. Row 25 of the requirements.
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

// Begun together, the near one is received and the far one is lost, in either order within the 4 us of detection.
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

// At 6 Mbit/s bits are right at 3.6 dB, but no preamble is detected.
TEST(NearAndFar, OfTwoThatAreAboutAsStrongNoneIsTakenUp) {
  Cell cell({{0, 0}, {2, 0}, {2 + 2 * std::pow(10, 0.12), 0}});
  cell.hide(0, 2);
  for (const std::size_t from : {0, 2}) cell.medium.ask(second / 2, from, 1, "x");
  Settings s = settings();
  s.acknowledged = false;
  EXPECT_TRUE(cell.run(s).arrivals.empty());
}

// After that time the lock is kept, and the near one drowns the frame.
TEST(NearAndFar, ALaterOneDrownsWhatIsHeard) {
  Cell cell({{0, 0}, {2, 0}, {20, 0}});
  cell.hide(0, 2);
  cell.medium.ask(second / 2, 2, 1, std::string(100, 'x'));
  cell.medium.ask(second / 2 + 5 * microsecond, 0, 1, std::string(100, 'x'));
  Settings s = settings();
  s.acknowledged = false;
  EXPECT_TRUE(cell.run(s).arrivals.empty());
}

}  // namespace
}  // namespace muster::wifi
