// The lr-wpan module of ns-3 as a backend: IEEE 802.15.4 at 2.4 GHz.
#pragma once

#include <memory>

#include "backend.hpp"

namespace muster::external {

struct LrWpanSettings {
  double noise = -106.987;  // dBm
  bool acknowledge = true;  // of messages to one receiver
  std::size_t queue = 16;   // limit of messages at a radio beside the one that it sends
};

// True if another simulation of ns-3 runs in this process, which holds one at a time.
bool is_ns3_taken();

std::unique_ptr<Backend> make_ns3_lr_wpan(const LrWpanSettings& settings);

}  // namespace muster::external
