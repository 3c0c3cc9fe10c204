// network.ns3: ns-3 under our channel.
#include "adaptor.hpp"
#include "ns3_lr_wpan.hpp"

namespace {

using namespace muster;

struct NetworkNs3 {
  static constexpr auto id = "network.ns3/1";
  static constexpr auto summary = "IEEE 802.15.4 by ns-3 3.37 (its module lr-wpan), under this world's channel";
  static constexpr auto manual =
      R"(ns-3's own radios, medium access and error model; received power is link/*/level with link/*/fading, and places
are those of the world. What a receiver's chain makes null is not heard. Every copy has one outcome in
radio/*/traffic; ns-3 does not say why a receiver missed a frame: beyond 3 dB above noise it counts as collided,
below as too weak.
ns-3's state cannot be saved: a run with it goes from its start, and is refused after restore, remake or a tick
that was taken back. ns-3 holds one simulation a process: a second one is refused.)";
  static constexpr auto phase = MUSTER_NETWORK;
  static constexpr auto cannot_hold = "messages that another network has under way";
  static constexpr Param params[] = {
      real("noise", -106.987, -250, 50, "dBm", "of a receiver; as it stands when the run begins"),
      flag("acknowledge", true, "messages to one receiver are acknowledged"),
      integer("queue", 16, 0, 1e6, "messages that may wait at a radio beside the one that it sends"),
      external::Adaptor::spread_param,
  };

  explicit NetworkNs3(Setup& s)
      : noise(s.value("noise")), acknowledge(s.value("acknowledge")), queue(s.value("queue")), adaptor(s) {}

  void step(const Step& k) {
    const auto make = [&] {
      if (external::is_ns3_taken())
        throw BadInput("ns-3 holds one simulation a process, and another instance has it; expected one network.ns3");
      return external::make_ns3_lr_wpan({k[noise], k[acknowledge] != 0, static_cast<std::size_t>(k[queue])});
    };
    adaptor.step(k, make, k[noise]);
  }

  Value noise, acknowledge, queue;
  external::Adaptor adaptor;
};

}  // namespace

MUSTER_PLUGIN_IS(NetworkNs3)
