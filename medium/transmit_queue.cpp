#include "medium/transmit_queue.hpp"

namespace muster::medium {

DeliveryOutcome fate_of(Heard heard) {
  switch (heard) {
    case Heard::whole:
      return DeliveryOutcome::delivered;
    case Heard::too_weak:
      return DeliveryOutcome::too_weak;
    case Heard::no_link:
      return DeliveryOutcome::no_link;
    case Heard::collided:
      return DeliveryOutcome::collided;
    default:
      return DeliveryOutcome::gone;
  }
}

void TransmitQueue::ask(Time at, std::size_t from, std::size_t to, std::string payload) {
  requests_.push_back({at, from, to, std::move(payload)});
}

void TransmitQueue::open(const Channel& channel) {
  channel_ = &channel;
  report_.arrivals.clear(), report_.deliveries.clear();
  report_.fates.assign(channel.radios, {});
  queues_.resize(channel.radios);
  for (std::size_t i = 0; i < channel.radios; ++i) {
    if (channel.alive[i]) continue;
    for (Message& message : queues_[i]) settle(i, message, DeliveryOutcome::gone);
    queues_[i].clear();
  }
}

const Report& TransmitQueue::close() {
  requests_.clear();
  return report_;
}

bool TransmitQueue::take(std::size_t number, std::size_t limit) {
  Request& request = requests_[number];
  const std::size_t from = request.from;
  Message message;
  message.asked = request.at;
  message.to = request.to;
  message.size = request.payload.size();
  message.payload = std::move(request.payload);
  message.receivers = Receivers(request.to);
  if (request.to == everyone) {
    std::vector<std::uint8_t> others = channel_->alive;
    others[from] = false;
    message.receivers = Receivers(std::move(others));
  }
  count(from, DeliveryOutcome::under_way, message.receivers.count());
  if (!channel_->alive[from]) {
    settle(from, message, DeliveryOutcome::gone);
  } else if (request.to == from) {
    settle(from, message, DeliveryOutcome::no_link);
  } else if (queues_[from].size() > limit) {
    settle(from, message, DeliveryOutcome::queue_full);
  } else {
    queues_[from].push_back(std::move(message));
    return queues_[from].size() == 1;
  }
  return false;
}

void TransmitQueue::frame_heard(std::size_t sender, const std::vector<Heard>& heard) {
  Receivers& receivers = first(sender).receivers;
  for (std::size_t i = 0; i < heard.size(); ++i) {
    if (heard[i] == Heard::whole || !receivers.has(i)) continue;
    count(sender, fate_of(heard[i]));
    receivers.drop(i);
  }
}

void TransmitQueue::last_frame_heard(std::size_t sender, const std::vector<Heard>& heard, const Air& air, Time at) {
  std::array<std::size_t, static_cast<std::size_t>(Heard::gone) + 1> lost{};
  Message& message = first(sender);
  const std::size_t before = report_.deliveries.size();
  message.receivers.each([&](std::size_t to) {
    if (heard[to] == Heard::whole)
      put_delivery(to, air);
    else
      ++lost[static_cast<std::size_t>(heard[to])];
  });
  const std::size_t delivered = report_.deliveries.size() - before;
  count(sender, DeliveryOutcome::delivered, delivered);
  if (delivered > 0) put_arrival(sender, at);
  for (const Heard each : {Heard::too_weak, Heard::no_link, Heard::collided, Heard::gone})
    count(sender, fate_of(each), lost[static_cast<std::size_t>(each)]);
  message.receivers = {};
}

void TransmitQueue::deliver(std::size_t sender, std::size_t to, const Air& air, Time at) {
  if (!first(sender).receivers.has(to)) return;
  count(sender, DeliveryOutcome::delivered);
  put_delivery(to, air);
  put_arrival(sender, at);
  first(sender).receivers.drop(to);
}

void TransmitQueue::put_arrival(std::size_t sender, Time at) {
  Message& message = first(sender);
  report_.arrivals.push_back({sender, message.asked, at, std::move(message.payload)});
}

// Must precede the arrival that it refers to.
void TransmitQueue::put_delivery(std::size_t to, const Air& air) {
  const auto arrival = static_cast<std::uint32_t>(report_.arrivals.size());
  report_.deliveries.emplace_back(arrival, static_cast<std::uint32_t>(to), air.rssi(to), air.ratio(to));
}

void TransmitQueue::settle(std::size_t sender, Message& message, DeliveryOutcome fate) {
  count(sender, fate, message.receivers.count());
  message.receivers = {};
}

void TransmitQueue::save(Writer& out) const {
  out.put(queues_.size());
  for (const auto& queue : queues_) {
    out.put(queue.size());
    for (const Message& message : queue) {
      out.put(message.asked), out.put(message.to), out.put(message.size), out.put(message.frame);
      out.put_text(message.payload);
      message.receivers.save(out);
    }
  }
}

void TransmitQueue::load(Reader& in) {
  queues_.resize(in.count());
  for (auto& queue : queues_) {
    queue.resize(in.count());
    for (Message& message : queue) {
      in.get(message.asked), in.get(message.to), in.get(message.size), in.get(message.frame);
      message.payload = in.text();
      message.receivers.load(in);
    }
  }
}

}  // namespace muster::medium
