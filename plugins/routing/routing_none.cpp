// Single-hop messages: no relaying.
#include "router.hpp"

namespace {

using namespace muster;
using namespace muster::routing;

struct OneHop final : Protocol {
  void originate(Fabric& fabric, Radio at, Packet packet) override {
    const Radio to = packet.target;
    fabric.send(at, to, std::move(packet));
  }
  void receive(Fabric& fabric, Radio at, Radio, Packet packet) override {
    if (packet.kind == Packet::Kind::data) fabric.deliver(at, packet);
  }
};

struct RoutingNone {
  static constexpr auto id = "routing.none/1";
  static constexpr auto summary = "messages go as far as their sender is heard";
  static constexpr auto manual =
      R"(The yardstick of the other routings: the same packets and counts, without relays. A message reaches whom its
sender reaches itself.)";
  static constexpr auto phase = Router::phase;
  static constexpr bool keeps_only_caches = true;
  static constexpr Param params[] = {Router::queue_param};

  explicit RoutingNone(Setup& s) : router(s) {}
  void step(const Step& k) { router.step(k, protocol); }

  Router router;
  OneHop protocol;
};

}  // namespace

MUSTER_PLUGIN_IS(RoutingNone)
