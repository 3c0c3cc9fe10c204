#include "aodv.hpp"

#include <algorithm>
#include <utility>

#include "aodv_messages.hpp"

namespace muster::routing {
namespace {

// Sequence numbers roll over (section 6.1).
bool is_newer(std::uint32_t a, std::uint32_t b) { return static_cast<std::int32_t>(a - b) > 0; }
std::uint32_t newest(std::uint32_t a, std::uint32_t b) { return is_newer(a, b) ? a : b; }

}  // namespace

// ---- Data ---------------------------------------------------------------------------------------------------------

Aodv::Route* Aodv::valid(Radio at, Radio to) {
  auto& routes = nodes_[at].routes;
  const auto found = routes.find(to);
  return found != routes.end() && found->second.is_valid ? &found->second : nullptr;
}

const Aodv::Route* Aodv::route(Radio at, Radio to) const {
  const auto node = nodes_.find(at);
  if (node == nodes_.end()) return nullptr;
  const auto found = node->second.routes.find(to);
  return found != node->second.routes.end() && found->second.is_valid ? &found->second : nullptr;
}

// Refreshes a route in use (section 6.2).
void Aodv::touch(Fabric& fabric, Radio at, Radio to) {
  if (Route* used = valid(at, to)) used->until = std::max(used->until, fabric.now() + settings.active_route_timeout);
}

void Aodv::send_along(Fabric& fabric, Radio at, const Route& route, Packet packet) {
  const Radio next = route.next;
  touch(fabric, at, packet.target), touch(fabric, at, next);
  fabric.send(at, next, std::move(packet));
}

void Aodv::originate(Fabric& fabric, Radio at, Packet packet) {
  const Radio to = packet.target;
  packet.ttl = static_cast<std::uint8_t>(to == everyone ? 1 : settings.net_diameter);
  if (to == everyone) return fabric.send(at, everyone, std::move(packet));
  if (const Route* known = valid(at, to)) return send_along(fabric, at, *known, std::move(packet));
  fabric.park(at, std::move(packet));
  if (!nodes_[at].searches.count(to)) search(fabric, at, to);
}

void Aodv::forward(Fabric& fabric, Radio at, Radio from, Packet packet) {
  touch(fabric, at, packet.origin), touch(fabric, at, from);
  if (packet.target == at || packet.target == everyone) return fabric.deliver(at, packet);
  if (Route* known = valid(at, packet.target)) {
    if (packet.ttl <= 1) return fabric.end(packet, Outcome::ttl_expired);
    --packet.ttl;
    return send_along(fabric, at, *known, std::move(packet));
  }
  // Section 6.11, case (ii).
  const auto held = nodes_[at].routes.find(packet.target);
  const bool is_held = held != nodes_[at].routes.end();
  if (is_held && held->second.is_sequence_known) ++held->second.sequence;
  if (is_held) held->second.until = fabric.now() + settings.delete_period();
  report(fabric, at, {{packet.target, is_held ? held->second.sequence : 0}});
  fabric.end(packet, Outcome::no_route);
}

void Aodv::receive(Fabric& fabric, Radio at, Radio from, Packet packet) {
  if (packet.kind == Packet::Kind::data) return forward(fabric, at, from, std::move(packet));
  hear(fabric, at, from);
  medium::Reader in(packet.payload);
  switch (in.get<Message>()) {
    case Message::request:
      return receive_request(fabric, at, from, Request(in), packet.ttl);
    case Message::reply:
      return receive_reply(fabric, at, from, Reply(in));
    case Message::error:
      std::vector<Unreachable> lost(in.get<std::uint8_t>());
      for (auto& [to, sequence] : lost) in.get(to), in.get(sequence);
      return receive_error(fabric, at, from, lost);
  }
}

// ---- Routes -------------------------------------------------------------------------------------------------------

// A heard neighbour is one hop away; its sequence number is unknown (section 6.5).
void Aodv::hear(Fabric& fabric, Radio at, Radio neighbour) {
  Route& route = nodes_[at].routes[neighbour];
  const bool is_direct = route.is_valid && route.next == neighbour;
  route.next = neighbour;
  route.hops = 1;
  route.until = std::max(is_direct ? route.until : 0, fabric.now() + settings.active_route_timeout);
  route.is_valid = true;
  release(fabric, at, neighbour);
}

// Accepts newer routes, or equally new and better ones (section 6.2). True if accepted.
bool Aodv::learn(Fabric& fabric, Radio at, Radio to, const Route& news) {
  Route& route = nodes_[at].routes[to];
  const bool is_as_new = news.sequence == route.sequence && (!route.is_valid || news.hops < route.hops);
  if (route.is_sequence_known && !is_newer(news.sequence, route.sequence) && !is_as_new) return false;
  const double until = route.is_valid ? std::max(route.until, news.until) : news.until;
  auto precursors = std::move(route.precursors);
  route = news;
  route.until = until;
  route.precursors = std::move(precursors);
  release(fabric, at, to);
  return true;
}

// Sends the packets that waited for a route.
void Aodv::release(Fabric& fabric, Radio at, Radio to) {
  if (!nodes_[at].searches.erase(to)) return;
  for (Packet& packet : fabric.unpark(at, to)) {
    if (const Route* known = valid(at, to)) send_along(fabric, at, *known, std::move(packet));
  }
}

// ---- Searches -----------------------------------------------------------------------------------------------------

// Expanding ring search (section 6.4).
void Aodv::search(Fabric& fabric, Radio at, Radio to) {
  const auto known = nodes_[at].routes.find(to);
  const int hops = known == nodes_[at].routes.end() ? 0 : static_cast<int>(known->second.hops);
  Search& search = nodes_[at].searches[to];
  search.ttl = hops > 0 ? hops + settings.ttl_increment : settings.ttl_start;
  if (search.ttl > settings.ttl_threshold) search.ttl = settings.net_diameter;
  const bool is_whole = search.ttl >= settings.net_diameter;
  search.until = fabric.now() + (is_whole ? settings.net_traversal_time() : settings.ring_traversal_time(search.ttl));
  request(fabric, at, to, search.ttl);
}

// Section 6.3: in the whole network, rreq_retries times more, each twice as long.
void Aodv::search_on(Fabric& fabric, Radio at, Radio to, Search& search) {
  if (search.ttl >= settings.net_diameter) {
    if (search.retries == settings.rreq_retries) {
      nodes_[at].searches.erase(to);
      for (const Packet& packet : fabric.unpark(at, to)) fabric.end(packet, Outcome::no_route);
      return;
    }
    ++search.retries;
  } else {
    search.ttl += settings.ttl_increment;
    if (search.ttl > settings.ttl_threshold) search.ttl = settings.net_diameter;
  }
  const bool is_whole = search.ttl >= settings.net_diameter;
  search.until = fabric.now() + (is_whole ? settings.net_traversal_time() * (1 << search.retries)
                                          : settings.ring_traversal_time(search.ttl));
  request(fabric, at, to, search.ttl);
}

void Aodv::request(Fabric& fabric, Radio at, Radio to, int ttl) {
  Node& node = nodes_[at];
  Request request;
  request.number = ++node.last_request;
  request.to = to;
  const auto known = node.routes.find(to);
  request.is_sequence_unknown = known == node.routes.end() || !known->second.is_sequence_known;
  if (!request.is_sequence_unknown) request.to_sequence = known->second.sequence;
  request.from = at;
  request.from_sequence = ++node.sequence;
  node.heard[{at, request.number}] = fabric.now() + settings.path_discovery_time();
  fabric.send(at, everyone, request.packet(ttl));
}

// Section 6.5.
void Aodv::receive_request(Fabric& fabric, Radio at, Radio from, Request request, int ttl) {
  Node& node = nodes_[at];
  const double now = fabric.now();
  if (request.from == at || !node.heard.emplace(std::pair(request.from, request.number), 0).second) return;
  node.heard[{request.from, request.number}] = now + settings.path_discovery_time();
  ++request.hops;
  Route back;
  back.next = from;
  back.sequence = request.from_sequence;
  back.is_sequence_known = back.is_valid = true;
  back.hops = request.hops;
  back.until = now + 2 * settings.net_traversal_time() - 2 * request.hops * settings.node_traversal_time;
  learn(fabric, at, request.from, back);

  Reply answer;
  answer.to = request.to;
  answer.from = request.from;
  Route* known = valid(at, request.to);
  if (request.to == at) {  // section 6.6.1
    if (!request.is_sequence_unknown) node.sequence = newest(node.sequence, request.to_sequence);
    answer.to_sequence = node.sequence;
    answer.lifetime = static_cast<std::uint32_t>(1e3 * settings.my_route_timeout());
    return reply(fabric, at, answer);
  }
  const bool is_fresh = known && known->is_sequence_known && known->next != from &&
                        (request.is_sequence_unknown || !is_newer(request.to_sequence, known->sequence));
  if (is_fresh) {  // section 6.6.2
    answer.to_sequence = known->sequence;
    answer.hops = static_cast<std::uint8_t>(known->hops);
    answer.lifetime = static_cast<std::uint32_t>(1e3 * std::max(0.0, known->until - now));
    known->precursors.insert(from);
    if (Route* reverse = valid(at, request.from)) reverse->precursors.insert(known->next);
    return reply(fabric, at, answer);
  }
  if (ttl <= 1) return;
  const auto held = node.routes.find(request.to);
  if (held != node.routes.end() && held->second.is_sequence_known) {
    request.to_sequence =
        request.is_sequence_unknown ? held->second.sequence : newest(request.to_sequence, held->second.sequence);
    request.is_sequence_unknown = false;
  }
  fabric.send(at, everyone, request.packet(ttl - 1));
}

void Aodv::reply(Fabric& fabric, Radio at, const Reply& reply) {
  if (const Route* back = valid(at, reply.from)) fabric.send(at, back->next, reply.packet(settings.net_diameter));
}

// Section 6.7.
void Aodv::receive_reply(Fabric& fabric, Radio at, Radio from, Reply answer) {
  ++answer.hops;
  Route forth;
  forth.next = from;
  forth.sequence = answer.to_sequence;
  forth.is_sequence_known = forth.is_valid = true;
  forth.hops = answer.hops;
  forth.until = fabric.now() + 1e-3 * answer.lifetime;
  learn(fabric, at, answer.to, forth);
  if (answer.from == at) return;
  Route* known = valid(at, answer.to);
  Route* back = valid(at, answer.from);
  if (!known || !back) return;
  known->precursors.insert(back->next);
  if (Route* next = valid(at, known->next)) next->precursors.insert(back->next);
  touch(fabric, at, answer.from);
  reply(fabric, at, answer);
}

// ---- Errors, section 6.11 -----------------------------------------------------------------------------------------

// The error message for its precursors, if there are any.
std::optional<Aodv::Unreachable> Aodv::invalidate(Fabric& fabric, Route& route, Radio to) {
  route.is_valid = false;
  route.until = fabric.now() + settings.delete_period();
  const bool is_used = !std::exchange(route.precursors, {}).empty();
  return is_used ? std::optional<Unreachable>({to, route.sequence}) : std::nullopt;
}

void Aodv::lost_neighbour(Fabric& fabric, Radio at, Radio neighbour) {
  std::vector<Unreachable> lost;
  for (auto& [to, route] : nodes_[at].routes) {
    if (!route.is_valid || route.next != neighbour) continue;
    if (route.is_sequence_known) ++route.sequence;
    if (const auto told = invalidate(fabric, route, to)) lost.push_back(*told);
  }
  report(fabric, at, lost);
}

void Aodv::report(Fabric& fabric, Radio at, const std::vector<Unreachable>& lost) {
  for (std::size_t first = 0; first < lost.size(); first += 255) {
    const std::size_t count = std::min<std::size_t>(255, lost.size() - first);
    medium::Writer out;
    out.put(Message::error), out.put(static_cast<std::uint8_t>(count));
    for (std::size_t i = first; i < first + count; ++i) out.put(lost[i].to), out.put(lost[i].sequence);
    fabric.send(at, everyone, control(out, 1));
  }
}

void Aodv::receive_error(Fabric& fabric, Radio at, Radio from, const std::vector<Unreachable>& lost) {
  std::vector<Unreachable> told;
  for (const auto& [to, sequence] : lost) {
    Route* route = valid(at, to);
    if (!route || route->next != from || to == from) continue;
    route->sequence = route->is_sequence_known ? newest(route->sequence, sequence) : sequence;
    route->is_sequence_known = true;
    if (const auto on = invalidate(fabric, *route, to)) told.push_back(*on);
  }
  report(fabric, at, told);
}

// ---- Time ---------------------------------------------------------------------------------------------------------

void Aodv::pass_time(Fabric& fabric) {
  const double now = fabric.now();
  for (auto& [at, node] : nodes_) {
    for (auto route = node.routes.begin(); route != node.routes.end();) {
      if (route->second.until > now) {
        ++route;
      } else if (route->second.is_valid) {
        if (route->second.is_sequence_known) ++route->second.sequence;
        invalidate(fabric, route->second, route->first);
        ++route;
      } else {
        route = node.routes.erase(route);
      }
    }
    for (auto heard = node.heard.begin(); heard != node.heard.end();)
      heard = heard->second > now ? std::next(heard) : node.heard.erase(heard);
    for (auto next = node.searches.begin(); next != node.searches.end();) {
      const auto search = next++;  // which may end
      if (search->second.until <= now) search_on(fabric, at, search->first, search->second);
    }
  }
}

// ---- State --------------------------------------------------------------------------------------------------------

std::string Aodv::save() const {
  medium::Writer out;
  out.put(nodes_.size());
  for (const auto& [radio, node] : nodes_) {
    out.put(radio), out.put(node.sequence), out.put(node.last_request);
    out.put(node.routes.size());
    for (const auto& [to, route] : node.routes) {
      out.put(to), out.put(route.next), out.put(route.sequence), out.put(route.is_sequence_known);
      out.put(route.is_valid), out.put(route.hops), out.put(route.until);
      out.put_all(std::vector<Radio>(route.precursors.begin(), route.precursors.end()));
    }
    out.put(node.heard.size());
    for (const auto& [request, until] : node.heard) out.put(request.first), out.put(request.second), out.put(until);
    out.put(node.searches.size());
    for (const auto& [to, search] : node.searches)
      out.put(to), out.put(search.ttl), out.put(search.retries), out.put(search.until);
  }
  return out.take();
}

void Aodv::load(std::string_view bytes) {
  nodes_.clear();
  if (bytes.empty()) return;
  medium::Reader in(bytes);
  for (auto left = in.get<std::size_t>(); left > 0; --left) {
    Node& node = nodes_[in.get<Radio>()];
    in.get(node.sequence), in.get(node.last_request);
    for (auto routes = in.get<std::size_t>(); routes > 0; --routes) {
      Route& route = node.routes[in.get<Radio>()];
      in.get(route.next), in.get(route.sequence), in.get(route.is_sequence_known);
      in.get(route.is_valid), in.get(route.hops), in.get(route.until);
      std::vector<Radio> precursors;
      in.get_all(precursors);
      route.precursors = {precursors.begin(), precursors.end()};
    }
    for (auto heard = in.get<std::size_t>(); heard > 0; --heard) {
      const auto from = in.get<Radio>();
      const auto number = in.get<std::uint32_t>();
      in.get(node.heard[{from, number}]);
    }
    for (auto searches = in.get<std::size_t>(); searches > 0; --searches) {
      Search& search = node.searches[in.get<Radio>()];
      in.get(search.ttl), in.get(search.retries), in.get(search.until);
    }
  }
}

}  // namespace muster::routing
