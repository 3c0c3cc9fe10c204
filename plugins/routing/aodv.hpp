// Ad hoc on-demand distance vector routing: Perkins, Belding-Royer, Das, RFC 3561 (2003), with its names, numbers and
// sections.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <vector>

#include "protocol.hpp"

namespace muster::routing {

class Aodv final : public Protocol {
 public:
  // Section 10.
  struct Settings {
    double node_traversal_time = 0.04;  // s, as all times here
    double active_route_timeout = 3;
    int net_diameter = 35, ttl_start = 1, ttl_increment = 2, ttl_threshold = 7, rreq_retries = 2;

    double net_traversal_time() const { return 2 * node_traversal_time * net_diameter; }
    double path_discovery_time() const { return 2 * net_traversal_time(); }
    double ring_traversal_time(int ttl) const { return 2 * node_traversal_time * (ttl + timeout_buffer); }
    double my_route_timeout() const { return 2 * active_route_timeout; }
    double delete_period() const { return 5 * active_route_timeout; }
    static constexpr int timeout_buffer = 2;
  };

  struct Route {
    Radio next = 0;
    std::uint32_t sequence = 0;  // of the destination
    bool is_sequence_known = false, is_valid = false;
    std::uint32_t hops = 0;
    double until = 0;            // its expiry; of an invalid route, its deletion
    std::set<Radio> precursors;  // radios that send through this one
  };

  Settings settings;

  void originate(Fabric& fabric, Radio at, Packet packet) override;
  void receive(Fabric& fabric, Radio at, Radio from, Packet packet) override;
  void lost_neighbour(Fabric& fabric, Radio at, Radio neighbour) override;
  void forget(Radio at) override { nodes_.erase(at); }
  void pass_time(Fabric& fabric) override;
  bool parks() const override { return true; }
  std::string save() const override;
  void load(std::string_view bytes) override;

  // The valid route, or null.
  const Route* route(Radio at, Radio to) const;

 private:
  struct Search {
    int ttl = 0, retries = 0;
    double until = 0;
  };
  struct Node {
    std::uint32_t sequence = 0, last_request = 0;
    std::map<Radio, Route> routes;
    std::map<std::pair<Radio, std::uint32_t>, double> heard;  // requests by originator and number, until forgotten
    std::map<Radio, Search> searches;
  };
  struct Request;
  struct Reply;
  struct Unreachable {
    Radio to;
    std::uint32_t sequence;
  };

  Route* valid(Radio at, Radio to);
  void touch(Fabric& fabric, Radio at, Radio to);
  void send_along(Fabric& fabric, Radio at, const Route& route, Packet packet);
  void forward(Fabric& fabric, Radio at, Radio from, Packet packet);

  void hear(Fabric& fabric, Radio at, Radio neighbour);
  bool learn(Fabric& fabric, Radio at, Radio to, const Route& news);
  void release(Fabric& fabric, Radio at, Radio to);

  void search(Fabric& fabric, Radio at, Radio to);
  void search_on(Fabric& fabric, Radio at, Radio to, Search& search);
  void request(Fabric& fabric, Radio at, Radio to, int ttl);
  void receive_request(Fabric& fabric, Radio at, Radio from, Request request, int ttl);
  void reply(Fabric& fabric, Radio at, const Reply& reply);
  void receive_reply(Fabric& fabric, Radio at, Radio from, Reply reply);

  std::optional<Unreachable> invalidate(Fabric& fabric, Route& route, Radio to);
  void report(Fabric& fabric, Radio at, const std::vector<Unreachable>& lost);
  void receive_error(Fabric& fabric, Radio at, Radio from, const std::vector<Unreachable>& lost);

  std::map<Radio, Node> nodes_;
};

}  // namespace muster::routing
