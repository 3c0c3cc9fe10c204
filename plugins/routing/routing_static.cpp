// Static routing by a table in a file.
#include "router.hpp"

namespace {

using namespace muster;
using namespace muster::routing;

// `to` is null for all targets that have no row of their own.
struct Way {
  static constexpr const char* columns = "at:radio to:radio? next:radio .";
  double at, to, next;
};

struct Table final : Protocol {
  void originate(Fabric& fabric, Radio at, Packet packet) override {
    packet.ttl = packet.target == everyone ? 1 : ttl;
    go_on(fabric, at, std::move(packet), [&](Radio next, Packet first) { fabric.send(at, next, std::move(first)); });
  }
  void receive(Fabric& fabric, Radio at, Radio, Packet packet) override {
    if (packet.kind != Packet::Kind::data) return;
    if (packet.target == at || packet.target == everyone) return fabric.deliver(at, packet);
    go_on(fabric, at, std::move(packet), [&](Radio next, Packet on) { pass_on(fabric, at, next, std::move(on)); });
  }

  template <class Go>
  void go_on(Fabric& fabric, Radio at, Packet packet, Go&& go) const {
    if (packet.target == everyone) return go(everyone, std::move(packet));
    auto way = ways.find({at, packet.target});
    if (way == ways.end()) way = ways.find({at, everyone});
    if (way == ways.end()) return fabric.end(packet, Outcome::no_route);
    go(way->second, std::move(packet));
  }

  std::uint8_t ttl = 1;
  std::map<std::pair<Radio, Radio>, Radio> ways;  // by holder and target: the next hop
};

struct RoutingStatic {
  static constexpr auto id = "routing.static/1";
  static constexpr auto summary = "messages go along a table of next hops";
  static constexpr auto manual =
      R"(A row of `routes` says to whom a message goes next, by the radio that has it and the one that it is for; an
empty `to` stands for all that have no row of their own. A message for whom there is no row ends as no_route;
one that goes round in the table ends as ttl_expired. Broadcasts reach the neighbours.)";
  static constexpr auto phase = Router::phase;
  static constexpr bool keeps_only_caches = true;
  static constexpr Param params[] = {file("routes", "a table with columns at, to, next: names of radios").required(),
                                     integer("ttl", 64, 1, 255, "hops that a message may go"), Router::queue_param};

  explicit RoutingStatic(Setup& s) : ttl(s.value("ttl")), routes(s.file<Way>("routes")), router(s) {}

  void step(const Step& k) {
    if (protocol.ways.empty()) read(k);
    protocol.ttl = static_cast<std::uint8_t>(k[ttl]);
    router.step(k, protocol);
  }

  void read(const Step& k) {
    for (std::size_t i = 0; i < k[routes].size(); ++i) {
      const Way& row = k[routes][i];
      const auto at = static_cast<Radio>(row.at), next = static_cast<Radio>(row.next);
      const Radio to = is_null(row.to) ? everyone : static_cast<Radio>(row.to);
      const auto refuse = [&](const std::string& what) {
        throw BadInput("routes, row " + std::to_string(i + 1) + ": " + std::string(k.name("radio", at)) + ' ' + what);
      };
      if (next == at) refuse("sends to itself; expected another radio as next");
      if (to == at) refuse("is where the message is for; expected a radio that still has to send it");
      if (!protocol.ways.emplace(std::pair(at, to), next).second)
        refuse("has a row for " + (to == everyone ? "all others" : std::string(k.name("radio", to))) +
               " already; expected one");
    }
  }

  Value ttl;
  In<Way> routes;
  Router router;
  Table protocol;
};

}  // namespace

MUSTER_PLUGIN_IS(RoutingStatic)
