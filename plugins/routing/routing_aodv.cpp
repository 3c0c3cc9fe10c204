// Routing on demand: AODV.
#include <algorithm>

#include "aodv.hpp"
#include "router.hpp"

namespace {

using namespace muster;
using namespace muster::routing;

struct RoutingAodv {
  static constexpr auto id = "routing.aodv/1";
  static constexpr auto summary = "finds ways on demand: ad hoc on-demand distance vector routing (RFC 3561)";
  static constexpr auto manual =
      R"(A radio that has no route floods a request, in rings that grow; its target, or who has a fresh route, sends a
reply back along the way that the request came. Sequence numbers of the targets keep routes free of loops. A
neighbour to which a packet did not arrive is gone, which errors tell those who sent by way of it. Names and
constants are those of RFC 3561. Broadcasts reach the neighbours. `node_traversal_time` is at least two ticks,
since a hop takes one or two, and `active_route_timeout` twenty.
Not modelled: hello messages, local repair, gratuitous replies, rate limits, blacklists, subnets, multicast.)";
  static constexpr auto phase = Router::phase;
  static constexpr bool keeps_only_caches = true;
  static constexpr Param params[] = {
      real("node_traversal_time", 0.04, 1e-4, 100, "s", "that a packet takes for a hop, roughly; at least two ticks"),
      real("active_route_timeout", 3, 0.01, 1e4, "s",
           "after which a route that is not used ends; at least twenty ticks"),
      integer("net_diameter", 35, 1, 255, "most hops between two radios"),
      integer("ttl_start", 1, 1, 255, "hops of the first request"),
      integer("ttl_increment", 2, 1, 255, "more hops for the next one"),
      integer("ttl_threshold", 7, 1, 255, "beyond which a request goes net_diameter hops"),
      integer("rreq_retries", 2, 0, 20, "of a request through all of the net"),
      Router::queue_param,
  };

  explicit RoutingAodv(Setup& s)
      : node_traversal_time(s.value("node_traversal_time")),
        active_route_timeout(s.value("active_route_timeout")),
        net_diameter(s.value("net_diameter")),
        ttl_start(s.value("ttl_start")),
        ttl_increment(s.value("ttl_increment")),
        ttl_threshold(s.value("ttl_threshold")),
        rreq_retries(s.value("rreq_retries")),
        router(s) {}

  void step(const Step& k) {
    Aodv::Settings& now = protocol.settings;
    now.node_traversal_time = std::max(k[node_traversal_time], 2 * k.dt());
    now.active_route_timeout = std::max(k[active_route_timeout], 20 * k.dt());
    now.net_diameter = static_cast<int>(k[net_diameter]);
    now.ttl_start = std::min(static_cast<int>(k[ttl_start]), now.net_diameter);
    now.ttl_increment = static_cast<int>(k[ttl_increment]);
    now.ttl_threshold = std::min(static_cast<int>(k[ttl_threshold]), now.net_diameter);
    now.rreq_retries = static_cast<int>(k[rreq_retries]);
    router.step(k, protocol);
  }

  Value node_traversal_time, active_route_timeout, net_diameter, ttl_start, ttl_increment, ttl_threshold, rreq_retries;
  Router router;
  Aodv protocol;
};

}  // namespace

MUSTER_PLUGIN_IS(RoutingAodv)
