// ns-3's 6LoWPAN with mesh-under routing as a backend: IPv6 over IEEE 802.15.4 (RFC 4944, RFC 6282); each receiver
// forwards each frame once.
#pragma once

#include <memory>

#include "backend.hpp"

namespace muster::external {

struct MeshSettings {
  double noise = -106.987;  // dBm
  std::size_t queue = 16;   // limit of messages at a radio beside the one that it sends
  unsigned hops = 10;       // limit of a frame's hops, 1 to 15
};

std::unique_ptr<Backend> make_ns3_mesh(const MeshSettings& settings);

}  // namespace muster::external
