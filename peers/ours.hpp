// Our media on the same tasks.
#pragma once

#include <algorithm>
#include <cmath>
#include <ctime>
#include <string>

#include "medium/transmit_queue.hpp"
#include "peers/task.hpp"

namespace muster::peers {

// Radios spread over a square, each of which sends once in every period, at any moment of it.
inline Task crowd(std::uint64_t seed, std::size_t radios, double side, double rate, double seconds) {
  const Stream random(combined(key_of("crowd"), seed));
  Task task;
  task.seconds = seconds;
  task.run = static_cast<unsigned>(seed) + 1;
  for (std::size_t i = 0; i < radios; ++i) {
    task.places.push_back({side * random.uniform(i, 0), side * random.uniform(i, 1)});
    for (std::size_t period = 0; static_cast<double>(period) < rate * seconds; ++period)
      task.requests.push_back(
          {(static_cast<double>(period) + random.uniform(i, 2 + period)) / rate, static_cast<std::uint32_t>(i)});
  }
  std::sort(task.requests.begin(), task.requests.end(), [](const Request& a, const Request& b) { return a.at < b.at; });
  return task;
}

// Two radios so far apart, of which the first sends.
inline Task pair_at(double distance, double rate, double seconds) {
  Task task;
  task.places = {{0, 0}, {distance, 0}};
  task.seconds = seconds;
  for (double at = 0; at < seconds; at += 1 / rate) task.requests.push_back({at, 0});
  return task;
}

inline medium::Channel channel_of(const std::vector<std::array<double, 2>>& places, double tx_power = 0,
                                  double sensitivity = -250) {
  medium::Channel c;
  const std::size_t n = c.radios = places.size();
  c.power.assign(n * n, 0);
  c.rssi.assign(n * n, std::nan(""));
  c.alive.assign(n, 1);
  for (std::size_t i = 0; i < n; ++i) {
    c.keys.push_back(mixed(i));
    for (std::size_t j = 0; j < n; ++j) {
      if (i == j) continue;
      const double d = std::max(1.0, std::hypot(places[i][0] - places[j][0], places[i][1] - places[j][1]));
      const double rssi = tx_power - 40 - 30 * std::log10(d);
      c.power[i * n + j] = medium::milliwatts(rssi);
      if (rssi >= sensitivity) c.rssi[i * n + j] = rssi;
    }
  }
  return c;
}

using Books = std::array<double, static_cast<std::size_t>(medium::DeliveryOutcome::count)>;
inline double of(const Books& books, medium::DeliveryOutcome fate) { return books[static_cast<std::size_t>(fate)]; }
inline void add(Books& books, const medium::Report& report) {
  for (const auto& radio : report.fates)
    for (std::size_t k = 0; k < books.size(); ++k) books[k] += static_cast<double>(radio[k]);
}

// In ticks of 0.1 s, as in a world.
template <class Medium, class Settings>
Counts run_ours(const Task& task, const medium::Channel& channel, const Settings& settings) {
  constexpr medium::Time tick = 100'000'000;
  Medium medium(Stream(combined(key_of("peers"), task.run)));
  Counts result;
  Books books{};
  std::size_t next = 0;
  const auto nanoseconds = [](double seconds) -> medium::Time { return std::llround(1e9 * seconds); };
  const std::string payload(task.payload, 'x');
  const medium::Time until = nanoseconds(task.seconds);
  const std::clock_t before = std::clock();
  for (medium::Time since = 0; since < until; since += tick) {
    const medium::Time end = std::min<medium::Time>(since + tick, until);
    for (; next < task.requests.size() && nanoseconds(task.requests[next].at) < end; ++next)
      medium.ask(nanoseconds(task.requests[next].at), task.requests[next].from, Medium::everyone, payload);
    add(books, medium.run(since, end, channel, settings));
  }
  result.cpu = static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
  const auto others = static_cast<double>(task.places.size() - 1);
  result.arrived = static_cast<std::uint64_t>(of(books, medium::DeliveryOutcome::delivered));
  result.no_access = static_cast<std::uint64_t>(std::llround(of(books, medium::DeliveryOutcome::no_access) / others));
  return result;
}

}  // namespace muster::peers
