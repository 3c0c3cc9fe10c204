// ns-3's 6LoWPAN with mesh-under routing as a backend: IPv6 over IEEE 802.15.4 (RFC 4944, RFC 6282), each frame passed
// on once by everyone who hears it.
#pragma once

#include <memory>

#include "backend.hpp"

namespace muster::external {

struct MeshSettings {
  double noise = -106.987;  // dBm
  std::size_t queue = 16;   // messages that may wait at a radio beside the one that it sends
  unsigned hops = 10;       // that a frame makes, 1 to 15
};

std::unique_ptr<Backend> make_ns3_mesh(const MeshSettings& settings);

}  // namespace muster::external
