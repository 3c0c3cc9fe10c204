// network.ns3: ns-3 on our channel.
#include "adaptor.hpp"
#include "ns3_lr_wpan.hpp"
#include "ns3_mesh.hpp"

namespace {

using namespace muster;

struct NetworkNs3 {
  static constexpr auto id = "network.ns3/2";
  static constexpr auto summary = "IEEE 802.15.4 by ns-3 3.37 (its module lr-wpan), under this world's channel";
  static constexpr auto manual =
      R"(ns-3's own radios, medium access and error model; received power is link/*/level with link/*/fading, and places
are those of the world. What a receiver's chain makes null is not heard. Every copy has one outcome in
radio/*/traffic; ns-3 does not say why a receiver missed a frame: beyond 3 dB above noise it counts as collided,
below as too weak. radio.pan puts radios into PANs.
routing="mesh": its 6LoWPAN (module sixlowpan) with mesh-under routing, RFC 4944 and 6282, without acknowledgements:
everyone who hears a frame passes it on once, up to `hops` hops in all. A copy that has not come 10 s after its last
frame left is lost: collided, or no_link if its receiver hears nobody. rssi and lqi are those of the last hop.
ns-3's state cannot be saved: a run with it goes from its start, and is refused after restore, remake or a tick
that was taken back. ns-3 holds one simulation a process: a second one is refused.)";
  static constexpr auto phase = MUSTER_NETWORK;
  static constexpr bool keeps_only_caches = true;
  static constexpr auto cannot_hold = "messages that another network has under way";
  static constexpr Param params[] = {
      real("noise", -106.987, -250, 50, "dBm", "of a receiver; as it stands when the run begins"),
      choice("routing", "none|mesh", "by ns-3 itself; as it stands when the run begins"),
      integer("hops", 10, 1, 15, "that a frame makes; only with routing=\"mesh\""),
      flag("acknowledge", true, "messages to one receiver are acknowledged; only with routing=\"none\""),
      integer("queue", 16, 0, 1e6, "messages that may wait at a radio beside the one that it sends"),
      medium::RequestMoments::spread_param,
  };

  explicit NetworkNs3(Setup& s)
      : noise(s.value("noise")),
        routing(s.value("routing")),
        hops(s.value("hops")),
        acknowledge(s.value("acknowledge")),
        queue(s.value("queue")),
        adaptor(s) {}

  void step(const Step& k) {
    const auto make = [&]() -> std::unique_ptr<external::Backend> {
      if (external::is_ns3_taken())
        throw BadInput("ns-3 holds one simulation a process, and another instance has it; expected one network.ns3");
      const auto waiting = static_cast<std::size_t>(k[queue]);
      if (k[routing] == mesh) return external::make_ns3_mesh({k[noise], waiting, static_cast<unsigned>(k[hops])});
      return external::make_ns3_lr_wpan({k[noise], k[acknowledge] != 0, waiting});
    };
    adaptor.step(k, make, k[noise]);
  }

  enum Routing { none, mesh };

  Value noise, routing, hops, acknowledge, queue;
  external::Adaptor adaptor;
};

}  // namespace

MUSTER_PLUGIN_IS(NetworkNs3)
