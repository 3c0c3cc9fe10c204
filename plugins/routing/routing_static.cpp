// Static routing by a table in a file.
#include <optional>
#include <set>

#include "plugins/table_rows.hpp"
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

  explicit RoutingStatic(Setup& s)
      : ttl(s.value("ttl")), places(s, "routes"), routes(s.file<Way>("routes")), router(s) {}

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
      const auto refuse = [&](const std::string& what) { throw BadInput(places.at(i) + name(k, at) + ' ' + what); };
      if (next == at) refuse("sends to itself; expected another radio as next");
      if (to == at) refuse("is where the message is for; expected a radio that still has to send it");
      const auto [known, is_new] = protocol.ways.emplace(std::pair(at, to), next);
      if (!is_new)
        refuse(known->second == next ? "has this row already; expected it once"
                                     : "has a row for " + (to == everyone ? "all others" : name(k, to)) +
                                           " already, by " + name(k, known->second) + "; expected one row, by " +
                                           name(k, known->second) + " or by " + name(k, next));
    }
    if (k.tick() <= 1) look_for_loops(k);
  }

  static std::string name(const Step& k, Radio radio) { return std::string(k.name("radio", radio)); }

  // Warns of each loop once, at the first of its rows that such a message takes, and of ways that end at a radio which
  // has no row for the target.
  void look_for_loops(const Step& k) const {
    std::set<std::set<Radio>> told;
    for (std::size_t i = 0; i < k[routes].size(); ++i) {
      const Way& row = k[routes][i];
      const auto at = static_cast<Radio>(row.at);
      for (Radio to = 0; to < k.rows("radio"); ++to) {
        const bool is_for = is_null(row.to) ? !protocol.ways.count({at, to}) : to == static_cast<Radio>(row.to);
        if (is_for && to != at) follow(k, i, at, to, told);
      }
    }
  }

  // The way of a message for `to` from `at`, whose row is number `row`.
  void follow(const Step& k, std::size_t row, Radio at, Radio to, std::set<std::set<Radio>>& told) const {
    std::vector<Radio> way = {at};
    const auto text = [&](std::size_t from) {
      std::string result;
      for (std::size_t i = from; i < way.size(); ++i) result += (i > from ? ", " : "") + name(k, way[i]);
      return result;
    };
    const std::string what = "messages for \"" + name(k, to) + "\" go ";
    while (way.back() != to) {
      const auto next = next_of(way.back(), to);
      if (!next) {
        if (way.size() == 2 && !is_null(k[routes][row].to))  // from further away it is the same fault
          warn(k, row,
               what + text(0) + ", which has no row for it, so that each ends there as no_route; expected a row " +
                   name(k, way.back()) + ',' + name(k, to) + ",NEXT");
        return;
      }
      const auto first = static_cast<std::size_t>(std::find(way.begin(), way.end(), *next) - way.begin());
      way.push_back(*next);
      if (first + 1 == way.size()) continue;
      std::set<Radio> loop(way.begin() + static_cast<std::ptrdiff_t>(first), way.end());
      loop.insert(static_cast<Radio>(k.rows("radio") + to));  // one of another target is another loop
      const Radio back = way[way.size() - 2];                 // whose row closes it
      if (told.insert(loop).second)
        warn(k, row_of(k, back, to),
             what + text(first) + ": a loop, in which each ends as ttl_expired; expected " + name(k, back) + ',' +
                 name(k, to) + ",NEXT with another NEXT than " + name(k, *next) + ", such as " + name(k, to) +
                 " itself");
      return;
    }
  }

  // The row that says where a message for `to` goes from there.
  std::size_t row_of(const Step& k, Radio at, Radio to) const {
    std::size_t found = 0;
    for (std::size_t i = 0; i < k[routes].size(); ++i) {
      const Way& row = k[routes][i];
      if (static_cast<Radio>(row.at) != at) continue;
      if (!is_null(row.to) && static_cast<Radio>(row.to) == to) return i;
      if (is_null(row.to)) found = i;
    }
    return found;
  }

  std::optional<Radio> next_of(Radio at, Radio to) const {
    auto way = protocol.ways.find({at, to});
    if (way == protocol.ways.end()) way = protocol.ways.find({at, everyone});
    return way == protocol.ways.end() ? std::nullopt : std::optional(way->second);
  }

  void warn(const Step& k, std::size_t row, const std::string& what) const {
    k.event("warning: " + places.at(row) + what);
  }

  Value ttl;
  TableRows places;
  In<Way> routes;
  Router router;
  Table protocol;
};

}  // namespace

MUSTER_PLUGIN_IS(RoutingStatic)
