// Flooding: each radio repeats every packet once.
#include "router.hpp"

namespace {

using namespace muster;
using namespace muster::routing;

struct Flooding final : Protocol {
  void originate(Fabric& fabric, Radio at, Packet packet) override {
    fabric.is_first(at, packet);
    packet.ttl = ttl;
    fabric.send(at, everyone, std::move(packet));
  }
  void receive(Fabric& fabric, Radio at, Radio, Packet packet) override {
    if (packet.kind != Packet::Kind::data || !fabric.is_first(at, packet)) return;
    const bool is_for_it = packet.target == at;
    if (is_for_it || packet.target == everyone) fabric.deliver(at, packet);
    if (!is_for_it) pass_on(fabric, at, everyone, std::move(packet));
  }

  std::uint8_t ttl = 1;
};

struct RoutingFlooding {
  static constexpr auto id = "routing.flooding/1";
  static constexpr auto summary = "every radio repeats each message once, up to a number of hops";
  static constexpr auto manual =
      R"(A message is broadcast; who hears it for the first time broadcasts it again, unless it is the one whom it
is for or `ttl` hops are gone. So it takes the shortest ways, all of them, at the cost of a transmission a
radio. Broadcasts reach everybody within `ttl` hops. Broadcasts are not acknowledged: where a network
loses one, only another neighbour's copy makes up for it.)";
  static constexpr auto phase = Router::phase;
  static constexpr bool keeps_only_caches = true;
  static constexpr Param params[] = {integer("ttl", 35, 1, 255, "hops that a message may go"), Router::queue_param};

  explicit RoutingFlooding(Setup& s) : ttl(s.value("ttl")), router(s) {}
  void step(const Step& k) {
    protocol.ttl = static_cast<std::uint8_t>(k[ttl]);
    router.step(k, protocol);
  }

  Value ttl;
  Router router;
  Flooding protocol;
};

}  // namespace

MUSTER_PLUGIN_IS(RoutingFlooding)
