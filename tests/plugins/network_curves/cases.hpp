// The cases for the comparison of our media with ns-3, and both sides of each.
#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "peers/media.hpp"

namespace muster::peers {

struct Case {
  std::string network;  // lr_wpan or wifi
  std::string kind;     // load: a crowd in 20 x 20 m; noise: two radios
  std::size_t radios;
  double x;  // load: messages a second and radio; noise: distance in m
  double seconds;
  unsigned runs;  // each with other places and moments

  Task task(unsigned run) const {
    if (kind == "load") return crowd(run, radios, 20, x, seconds);
    Task result = pair_at(x, 100, seconds);
    result.run = run + 1;
    return result;
  }
  Counts ours(const Task& t) const { return network == "wifi" ? our_wifi(t) : our_lr_wpan(t); }
};

inline std::vector<Case> cases() {
  std::vector<Case> result;
  for (const double rate : {1, 2, 4, 6, 8, 10, 15, 20}) result.push_back({"lr_wpan", "load", 50, rate, 10, 16});
  for (const double rate : {5, 20, 60}) result.push_back({"lr_wpan", "load", 10, rate, 20, 16});
  for (const double distance : {160, 170, 175, 180, 185, 190, 195, 200, 210})
    result.push_back({"lr_wpan", "noise", 2, distance, 25, 16});
  for (const double rate : {25, 50, 100, 150, 200, 300}) result.push_back({"wifi", "load", 20, rate, 1, 12});
  for (const double rate : {20, 60, 100}) result.push_back({"wifi", "load", 50, rate, 0.5, 6});
  return result;
}

// Shares of copies that arrive and of requests without a free channel, and the scatter of the first over the runs.
struct Curve {
  double arrived = 0, no_access = 0, scatter = 0;
};

inline Curve mean_of(const Case& c, const std::function<Counts(const Task&)>& simulator) {
  Curve mean;
  double squares = 0;
  for (unsigned run = 0; run < c.runs; ++run) {
    const Task task = c.task(run);
    const Counts counts = simulator(task);
    const auto asked = static_cast<double>(task.requests.size());
    const double share = static_cast<double>(counts.arrived) / asked / static_cast<double>(c.radios - 1);
    mean.arrived += share / c.runs;
    squares += share * share / c.runs;
    mean.no_access += static_cast<double>(counts.no_access) / asked / c.runs;
  }
  mean.scatter = std::sqrt(std::max(0.0, squares - mean.arrived * mean.arrived));
  return mean;
}

}  // namespace muster::peers
