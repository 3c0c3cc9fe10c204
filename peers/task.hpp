// One task for any simulator of networks: radios that stand in a plane and broadcast, under a loss of 40 dB + 30 dB a
// decade beyond 1 m.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace muster::peers {

struct Request {
  double at;  // s
  std::uint32_t from;
};

struct Task {
  std::vector<std::array<double, 2>> places;  // m
  std::vector<Request> requests;              // by time
  double seconds = 1;
  unsigned payload = 40;  // bytes
  unsigned run = 1;       // of the simulator's random numbers
};

struct Counts {
  std::uint64_t arrived = 0;    // copies
  std::uint64_t no_access = 0;  // messages that found no free channel
  double cpu = 0;               // s, of the simulation without its setup
};

}  // namespace muster::peers
