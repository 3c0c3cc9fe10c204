#include "adaptor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace muster::external {

using medium::DeliveryOutcome;

Adaptor::Adaptor(Setup& s)
    : request_(s.read<Outgoing>("outbox/*/message")),
      endpoint_(s.read<Endpoint>("endpoint/*/radio")),
      pose_(s.read<Pose>("endpoint/*/pose")),
      ends_(s.read<Ends>("link/*/ends")),
      level_(s.read<Level>("link/*/level")),
      fading_(s.read_if_any<Fading>("link/*/fading")),
      rssi_(s.read<Rssi>("link/*/rssi")),
      pan_(s.read_if_any<Pan>("radio/*/pan")),
      inbox_(s.write<Incoming>("inbox/*/message")),
      traffic_(s.write<Traffic>("radio/*/traffic")),
      progress_(s.write<Progress>("self/progress")),
      moments_(s),
      seed_(s.host()->stream(s.host(), "external simulator")) {}

void Adaptor::step(const Step& k, const std::function<std::unique_ptr<Backend>()>& make, double noise) {
  noise_ = noise;
  check_history(k);
  look(k);
  if (!backend_) begin(k, make);
  backend_->moved(world_);
  ask(k);
  backend_->advance(k.time());
  ++ticks_;
  hand_over(k);
  count(k);
  *k[progress_] = {static_cast<double>(ticks_), history()};
}

// Throws if the state differs from the one that this instance left: after a restored snapshot, or for an instance made
// in the midst of a run.
void Adaptor::check_history(const Step& k) const {
  const Progress& last = *k.last(progress_);
  if (last.ticks == static_cast<double>(ticks_) && last.history == history()) return;
  const auto ticks = [](double count) { return std::to_string(static_cast<std::uint64_t>(count)) + " ticks"; };
  throw BadInput("the simulator behind this network keeps its state to itself and cannot be restored: it has done " +
                 ticks(static_cast<double>(ticks_)) + " of its own, the run goes on after " + ticks(last.ticks) +
                 " of another past; expected a run from its start");
}

void Adaptor::begin(const Step& k, const std::function<std::unique_ptr<Backend>()>& make) {
  backend_ = make();
  backend_->deliver = [this](Arrival arrival) { deliver(std::move(arrival)); };
  backend_->end = [this](std::uint64_t message, End why) { end(message, why); };
  World start = world_;
  start.time = k.time() - k.dt();
  backend_->init(start, seed_);
}

void Adaptor::look(const Step& k) {
  const std::size_t n = k[traffic_].size();
  world_.time = k.time() - k.dt();
  world_.places.resize(n);
  world_.alive.resize(n);
  world_.pans.assign(n, 0);
  world_.level.assign(n * n, -std::numeric_limits<double>::infinity());
  world_.rssi.assign(n * n, null());
  fates_.assign(n, {});
  arrivals_.clear();
  for (std::size_t i = 0; i < n; ++i) world_.alive[i] = k.alive("radio", i);
  for (std::size_t i = 0; i < k[pan_].size(); ++i) world_.pans[i] = static_cast<std::uint16_t>(k[pan_][i].id);
  const auto radio = [&](std::size_t end) { return static_cast<std::size_t>(k[endpoint_][end].radio); };
  for (std::size_t i = 0; i < k[endpoint_].size(); ++i) {
    const Pose& at = k[pose_][i];
    world_.places[radio(i)] = {at.x, at.y, at.z};
  }
  const auto gains = k[fading_];
  for (std::size_t i = 0; i < k[ends_].size(); ++i) {
    const auto& [tx, rx] = k[ends_][i];
    const std::size_t at = radio(static_cast<std::size_t>(tx)) * n + radio(static_cast<std::size_t>(rx));
    world_.level[at] = k[level_][i].level + (gains.empty() ? 0 : 10 * std::log10(gains[i].gain));
    world_.rssi[at] = k[rssi_][i].rssi;
  }
  for (auto each = messages_.begin(); each != messages_.end();) {
    if (world_.alive[each->second.from]) {
      ++each;
      continue;
    }
    settle(each->second, DeliveryOutcome::gone);
    each = messages_.erase(each);
  }
}

void Adaptor::ask(const Step& k) {
  const auto requests = k[request_];
  moments_.start(fates_.size());
  for (std::size_t i = 0; i < requests.size(); ++i) {
    const auto from = static_cast<std::size_t>(requests[i].radio);
    const std::size_t to = is_null(requests[i].to) ? everyone : static_cast<std::size_t>(requests[i].to);
    Message message{from, moments_.next(k, from), medium::Receivers(to), to != everyone};
    if (to == everyone) {
      std::vector<std::uint8_t> others = world_.alive;
      others[from] = false;
      message.receivers = medium::Receivers(std::move(others));
    }
    fates_[from][static_cast<std::size_t>(DeliveryOutcome::under_way)] +=
        static_cast<double>(message.receivers.count());
    if (!world_.alive[from] || to == from) {
      settle(message, to == from ? DeliveryOutcome::no_link : DeliveryOutcome::gone);
      continue;
    }
    const std::string_view payload = k.bytes(request_, i, Outgoing::payload_column);
    note(from), note(to), note(key_of(payload));
    backend_->request({++last_message_, message.asked, from, to, std::string(payload)});
    messages_.emplace(last_message_, std::move(message));
  }
}

void Adaptor::deliver(Arrival arrival) {
  const auto found = messages_.find(arrival.message);
  if (found == messages_.end()) return;
  Message& message = found->second;
  if (!message.receivers.has(arrival.to) || !world_.alive[arrival.to] || is_null(arrival.rssi)) return;
  message.receivers.drop(arrival.to);
  ++fates_[message.from][static_cast<std::size_t>(DeliveryOutcome::delivered)];
  note(arrival.message), note(arrival.to);
  arrivals_.emplace_back(message, std::move(arrival));
}

void Adaptor::end(std::uint64_t number, End why) {
  const auto found = messages_.find(number);
  if (found == messages_.end()) return;
  Message& message = found->second;
  message.receivers.each(
      [&](std::size_t to) { ++fates_[message.from][static_cast<std::size_t>(fate_of(message, to, why))]; });
  messages_.erase(found);
}

// The simulator does not report why a receiver missed a frame. At 3 dB or more above noise, it counts as a collision.
DeliveryOutcome Adaptor::fate_of(const Message& message, std::size_t to, End why) const {
  if (!world_.alive[to]) return DeliveryOutcome::gone;
  if (why == End::queue_full) return DeliveryOutcome::queue_full;
  if (why == End::no_access) return DeliveryOutcome::no_access;
  const bool is_for_its_pan = !message.is_unicast || why == End::lost;  // no mesh crosses PANs
  if (is_for_its_pan && world_.pans[message.from] != world_.pans[to]) return DeliveryOutcome::no_link;
  if (why == End::lost) return hears_anybody(to) ? DeliveryOutcome::collided : DeliveryOutcome::no_link;
  const std::size_t link = world_.link(message.from, to);
  if (!std::isfinite(world_.level[link])) return DeliveryOutcome::no_link;
  if (is_null(world_.rssi[link]) || world_.level[link] < noise_ + 3) return DeliveryOutcome::too_weak;
  return why == End::no_ack ? DeliveryOutcome::no_ack : DeliveryOutcome::collided;
}

bool Adaptor::hears_anybody(std::size_t radio) const {
  for (std::size_t from = 0; from < world_.radios(); ++from) {
    const std::size_t link = world_.link(from, radio);
    if (world_.alive[from] && std::isfinite(world_.level[link]) && !is_null(world_.rssi[link])) return true;
  }
  return false;
}

void Adaptor::settle(Message& message, DeliveryOutcome fate) {
  fates_[message.from][static_cast<std::size_t>(fate)] += static_cast<double>(message.receivers.count());
  message.receivers = {};
}

void Adaptor::hand_over(const Step& k) {
  const auto made = k.append(inbox_, arrivals_.size());
  for (std::size_t i = 0; i < arrivals_.size(); ++i) {
    const auto& [message, arrival] = arrivals_[i];
    made[i].radio = static_cast<double>(arrival.to);
    made[i].from = static_cast<double>(message.from);
    made[i].rssi = arrival.rssi;
    // On the scale of network.lrwpan, from noise alone.
    const double snr = world_.level[world_.link(arrival.hop, arrival.to)] - noise_;
    made[i].lqi = std::round(255 * std::clamp((snr + 5) / 35, 0.0, 1.0));
    made[i].t_sent = message.asked;
    made[i].t_received = arrival.at;
    k.put_bytes(inbox_, i, Incoming::payload_column, arrival.payload);
  }
}

void Adaptor::count(const Step& k) {
  for (std::size_t i = 0; i < fates_.size(); ++i) {
    const auto made = [&](DeliveryOutcome fate) { return fates_[i][static_cast<std::size_t>(fate)]; };
    const Traffic& t = k.last(traffic_)[i];
    k[traffic_][i] = {t.asked + made(DeliveryOutcome::under_way),
                      t.delivered + made(DeliveryOutcome::delivered),
                      t.too_weak + made(DeliveryOutcome::too_weak),
                      t.no_link + made(DeliveryOutcome::no_link),
                      t.collided + made(DeliveryOutcome::collided),
                      t.no_access + made(DeliveryOutcome::no_access),
                      t.queue_full + made(DeliveryOutcome::queue_full),
                      t.no_ack + made(DeliveryOutcome::no_ack),
                      t.gone + made(DeliveryOutcome::gone)};
  }
}

}  // namespace muster::external
