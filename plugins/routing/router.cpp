#include "router.hpp"

#include <algorithm>
#include <set>
#include <utility>

namespace muster::routing {
namespace {

// Key of a packet, by its first bytes: unique among its sender's.
std::uint64_t head_of(std::string_view bytes) { return key_of(bytes.substr(0, 40)); }

double under_way(const Traffic& t) {
  return t.asked - (t.delivered + t.too_weak + t.no_link + t.collided + t.no_access + t.queue_full + t.no_ack + t.gone);
}

}  // namespace

Router::Router(Setup& s)
    : queue_(s.value("queue")),
      outbox_(s.modify<Outgoing>("outbox/*/message")),
      inbox_(s.modify<Incoming>("inbox/*/message")),
      traffic_(s.read<Traffic>("radio/*/traffic")),
      journeys_count_(s.write<Journeys>("radio/*/journeys")),
      relaying_count_(s.write<Relaying>("radio/*/relaying")),
      state_(s.write<State>("self/state")) {}

void Router::step(const Step& k, Protocol& protocol) {
  look(k, protocol);
  take_arrivals(k, protocol);
  settle(k, protocol);
  take_requests(k, protocol);
  protocol.pass_time(*this);
  hand_over(k);
  close();
  count(k);
  saved_ = save();
  saved_protocol_ = protocol.save();
  k.put_bytes(state_, 0, 0, saved_);
  k.put_bytes(state_, 0, 1, saved_protocol_);
}

void Router::look(const Step& k, Protocol& protocol) {
  if (const auto bytes = k.last_bytes(state_, 0, 0); bytes != saved_) load(bytes);
  if (const auto bytes = k.last_bytes(state_, 0, 1); bytes != saved_protocol_) protocol.load(bytes);
  k_ = &k;
  now_ = k.time();
  limit_ = static_cast<std::size_t>(k[queue_]);
  delivered_ = 0;
  const std::size_t n = k.rows("radio");
  nodes_.resize(n);
  alive_.resize(n);
  asked_.assign(n, 0);
  outcomes_.assign(n, {});
  relaying_.assign(n, {});
  for (Radio i = 0; i < n; ++i) {
    alive_[i] = k.alive("radio", i);
    if (!alive_[i]) clear(i, protocol);
    if (protocol.parks()) continue;
    // Packets that a protocol swapped out since has parked.
    for (Packet& packet : std::exchange(nodes_[i].parked, {})) {
      drop_copy(packet.journey);
      protocol.originate(*this, i, std::move(packet));
    }
  }
}

// Drops all packets of a radio that left.
void Router::clear(Radio at, Protocol& protocol) {
  Node& node = nodes_[at];
  for (const Queued& queued : node.queue) end(queued.packet, Outcome::gone), drop_copy(queued.packet.journey);
  for (const Packet& packet : node.parked) end(packet, Outcome::gone), drop_copy(packet.journey);
  node.queue.clear(), node.parked.clear();
  protocol.forget(at);
}

void Router::take_arrivals(const Step& k, Protocol& protocol) {
  const auto arrivals = k.before(inbox_);
  for (std::size_t i = 0; i < arrivals.size(); ++i) {
    const auto at = static_cast<Radio>(arrivals[i].radio), from = static_cast<Radio>(arrivals[i].from);
    const auto bytes = k.bytes(inbox_, i, Incoming::payload_column);
    note_arrival(at, from, bytes);
    if (!alive_[at]) continue;
    hop_ = &arrivals[i];
    protocol.receive(*this, at, from, decoded(bytes));
  }
}

void Router::note_arrival(Radio at, Radio from, std::string_view bytes) {
  const std::uint64_t head = head_of(bytes);
  for (Given& given : nodes_[from].given)
    if (given.to == at && given.head == head) given.arrived = true;
}

void Router::settle(const Step& k, Protocol& protocol) {
  for (Radio i = 0; i < nodes_.size(); ++i)
    if (!nodes_[i].given.empty() && (!alive_[i] || is_settled(nodes_[i], k[traffic_][i]))) settle(i, protocol);
}

bool Router::is_settled(const Node& node, const Traffic& traffic) const {
  const bool is_taken = traffic.asked >= node.asked + node.least;
  return (is_taken && under_way(traffic) <= node.under_way) || now_ > node.patience;
}

void Router::settle(Radio at, Protocol& protocol) {
  std::set<Radio> silent;
  for (const Given& given : std::exchange(nodes_[at].given, {})) {
    drop_copy(given.journey);
    if (given.to != everyone && !given.arrived) silent.insert(given.to);
  }
  if (!alive_[at]) return;
  for (const Radio neighbour : silent) protocol.lost_neighbour(*this, at, neighbour);
}

void Router::take_requests(const Step& k, Protocol& protocol) {
  const auto requests = k.before(outbox_);
  for (std::size_t i = 0; i < requests.size(); ++i) {
    Packet packet;
    packet.origin = static_cast<Radio>(requests[i].radio);
    packet.target = is_null(requests[i].to) ? everyone : static_cast<Radio>(requests[i].to);
    packet.journey = ++last_journey_;
    packet.t_sent = k.time();
    packet.payload = k.bytes(outbox_, i, Outgoing::payload_column);
    Journey& journey = journeys_[packet.journey];
    journey.origin = packet.origin;
    if (packet.target == everyone) {
      std::vector<std::uint8_t> others = alive_;
      others[packet.origin] = false;
      journey.receivers = medium::Receivers(std::move(others));
    } else {
      journey.receivers = medium::Receivers(std::size_t{packet.target});
    }
    const Radio from = packet.origin;
    asked_[from] += static_cast<double>(journey.receivers.count());
    if (!alive_[packet.origin])
      end(packet, Outcome::gone);
    else if (packet.target == packet.origin)
      end(packet, Outcome::no_route);
    else if (packet.target == everyone || alive_[packet.target])
      protocol.originate(*this, from, std::move(packet));
  }
}

// Control packets go first, for data wait for them.
void Router::send(Radio at, Radio to, Packet packet) {
  auto& queue = nodes_[at].queue;
  if (packet.kind == Packet::Kind::control) {
    const auto is_data = [](const Queued& queued) { return queued.packet.kind == Packet::Kind::data; };
    queue.insert(std::find_if(queue.begin(), queue.end(), is_data), Queued{to, std::move(packet)});
    return;
  }
  if (queue.size() >= limit_) return end(packet, Outcome::queue_full);
  count_copy(packet.journey);
  queue.push_back({to, std::move(packet)});
}

void Router::park(Radio at, Packet packet) {
  if (nodes_[at].parked.size() >= limit_) return end(packet, Outcome::queue_full);
  count_copy(packet.journey);
  nodes_[at].parked.push_back(std::move(packet));
}

std::vector<Packet> Router::unpark(Radio at, Radio target) {
  std::vector<Packet> result, kept;
  for (Packet& packet : nodes_[at].parked) {
    const bool is_for_it = packet.target == target;
    if (is_for_it) drop_copy(packet.journey);
    (is_for_it ? result : kept).push_back(std::move(packet));
  }
  nodes_[at].parked = std::move(kept);
  return result;
}

// Drops a late packet of a request that already counted as lost.
void Router::deliver(Radio at, const Packet& packet) {
  const auto journey = journeys_.find(packet.journey);
  if (journey == journeys_.end() || !journey->second.receivers.has(at)) return;
  journey->second.receivers.drop(at);
  ++outcomes_[packet.origin][static_cast<std::size_t>(Outcome::delivered)];
  Incoming& made = k_->send(inbox_, delivered_++, packet.payload);
  made.radio = at;
  made.from = packet.origin;
  made.rssi = hop_->rssi;
  made.lqi = hop_->lqi;
  made.t_sent = packet.t_sent;
  made.t_received = hop_->t_received;
}

void Router::end(const Packet& packet, Outcome outcome) {
  const auto journey = journeys_.find(packet.journey);
  if (journey != journeys_.end()) journey->second.worst = std::max(journey->second.worst, outcome);
}

bool Router::is_first(Radio at, const Packet& packet) {
  const auto journey = journeys_.find(packet.journey);
  if (journey == journeys_.end()) return false;
  auto& seen = journey->second.seen;
  seen.resize(nodes_.size());
  return !std::exchange(seen[at], true);
}

void Router::hand_over(const Step& k) {
  std::size_t row = 0;
  const auto alive = std::count(alive_.begin(), alive_.end(), true);
  for (Radio i = 0; i < nodes_.size(); ++i) {
    Node& node = nodes_[i];
    if (node.queue.empty() || !node.given.empty()) continue;
    node.asked = k[traffic_][i].asked;
    node.under_way = under_way(k[traffic_][i]);
    node.least = 0;
    // Time limit of a hop: 10 s, and a second for each kilobyte.
    node.patience = now_ + 10;
    for (const auto& [to, packet] : node.queue) {
      const std::string bytes = encoded(packet);
      Outgoing& made = k.send(outbox_, row++, bytes);
      made.radio = i;
      made.to = to == everyone ? null() : to;
      node.given.push_back({to, packet.journey, head_of(bytes), false});
      node.least += to != everyone || alive > 1;
      node.patience += 1e-3 * static_cast<double>(bytes.size());
      ++(packet.kind == Packet::Kind::control ? relaying_[i].control
         : packet.origin == i                 ? relaying_[i].own
                                              : relaying_[i].relayed);
    }
    node.queue.clear();
  }
}

void Router::count_copy(std::uint32_t journey) {
  const auto found = journeys_.find(journey);
  if (found != journeys_.end()) ++found->second.copies;
}

void Router::drop_copy(std::uint32_t journey) {
  const auto found = journeys_.find(journey);
  if (found != journeys_.end()) --found->second.copies;
}

// Closes requests of which no copy is left.
void Router::close() {
  for (auto each = journeys_.begin(); each != journeys_.end();) {
    const Journey& journey = each->second;
    if (journey.copies > 0) {
      ++each;
      continue;
    }
    journey.receivers.each([&](std::size_t radio) {
      const Outcome outcome = alive_[radio] ? journey.worst : Outcome::gone;
      ++outcomes_[journey.origin][static_cast<std::size_t>(outcome)];
    });
    each = journeys_.erase(each);
  }
}

void Router::count(const Step& k) {
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Journeys& was = k.last(journeys_count_)[i];
    const auto& [delivered, lost, gone, queue_full, no_route, ttl_expired] = outcomes_[i];
    k[journeys_count_][i] = {was.asked + asked_[i],
                             was.delivered + delivered,
                             was.lost + lost,
                             was.gone + gone,
                             was.queue_full + queue_full,
                             was.no_route + no_route,
                             was.ttl_expired + ttl_expired};
    const Relaying& before = k.last(relaying_count_)[i];
    k[relaying_count_][i] = {before.own + relaying_[i].own, before.relayed + relaying_[i].relayed,
                             before.control + relaying_[i].control};
  }
}

std::string Router::save() const {
  medium::Writer out;
  out.put(last_journey_);
  out.put(journeys_.size());
  for (const auto& [number, journey] : journeys_) {
    out.put(number), out.put(journey.origin), out.put(journey.copies), out.put(journey.worst);
    out.put_all(journey.seen);
    journey.receivers.save(out);
  }
  out.put(nodes_.size());
  for (const Node& node : nodes_) {
    out.put(node.queue.size());
    for (const auto& [to, packet] : node.queue) out.put(to), out.put_text(encoded(packet));
    out.put(node.parked.size());
    for (const Packet& packet : node.parked) out.put_text(encoded(packet));
    out.put(node.given.size());
    for (const Given& given : node.given)
      out.put(given.to), out.put(given.journey), out.put(given.head), out.put(given.arrived);
    out.put(node.asked), out.put(node.under_way), out.put(node.least), out.put(node.patience);
  }
  return out.take();
}

void Router::load(std::string_view bytes) {
  journeys_.clear(), nodes_.clear();
  last_journey_ = 0;
  if (bytes.empty()) return;
  medium::Reader in(bytes);
  in.get(last_journey_);
  for (auto left = in.get<std::size_t>(); left > 0; --left) {
    Journey& journey = journeys_[in.get<std::uint32_t>()];
    in.get(journey.origin), in.get(journey.copies), in.get(journey.worst);
    in.get_all(journey.seen);
    journey.receivers.load(in);
  }
  nodes_.resize(in.count());
  for (Node& node : nodes_) {
    node.queue.resize(in.count());
    for (auto& [to, packet] : node.queue) in.get(to), packet = decoded(in.text());
    node.parked.resize(in.count());
    for (Packet& packet : node.parked) packet = decoded(in.text());
    node.given.resize(in.count());
    for (Given& given : node.given) in.get(given.to), in.get(given.journey), in.get(given.head), in.get(given.arrived);
    in.get(node.asked), in.get(node.under_way), in.get(node.least), in.get(node.patience);
  }
}

}  // namespace muster::routing
