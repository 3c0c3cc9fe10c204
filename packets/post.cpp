#include "packets/post.hpp"

namespace muster::packets {

Fate fate_of(Heard heard) {
  switch (heard) {
    case Heard::whole:
      return Fate::delivered;
    case Heard::too_weak:
      return Fate::too_weak;
    case Heard::no_link:
      return Fate::no_link;
    case Heard::collided:
      return Fate::collided;
    default:
      return Fate::gone;
  }
}

void Post::ask(Time at, std::size_t from, std::size_t to, std::string payload) {
  requests_.push_back({at, from, to, std::move(payload)});
}

void Post::open(const Channel& channel) {
  channel_ = &channel;
  report_ = {};
  report_.fates.resize(channel.radios);
  queues_.resize(channel.radios);
  for (std::size_t i = 0; i < channel.radios; ++i) {
    if (channel.alive[i]) continue;
    for (Message& message : queues_[i]) settle(i, message, Fate::gone);
    queues_[i].clear();
  }
}

Report Post::close() {
  requests_.clear();
  return std::move(report_);
}

bool Post::take(std::size_t number, std::size_t limit) {
  Request& request = requests_[number];
  const std::size_t from = request.from;
  Message message{request.at, request.to, std::move(request.payload), Receivers(request.to), 0};
  if (request.to == everyone) {
    std::vector<std::uint8_t> others = channel_->alive;
    others[from] = false;
    message.receivers = Receivers(std::move(others));
  }
  message.receivers.each([&](std::size_t) {
    ++count(from, Fate::under_way);
    return false;
  });
  if (!channel_->alive[from]) {
    settle(from, message, Fate::gone);
  } else if (request.to == from) {
    settle(from, message, Fate::no_link);
  } else if (queues_[from].size() > limit) {
    settle(from, message, Fate::queue_full);
  } else {
    queues_[from].push_back(std::move(message));
    return queues_[from].size() == 1;
  }
  return false;
}

void Post::frame_heard(std::size_t sender, const std::vector<Heard>& heard, const Air& air, Time at, bool is_last) {
  first(sender).receivers.each([&](std::size_t to) {
    const bool arrived = heard[to] == Heard::whole;
    if (arrived && !is_last) return false;
    ++count(sender, fate_of(heard[to]));
    if (arrived) put_delivery(sender, to, air, at);
    return true;
  });
}

void Post::deliver(std::size_t sender, std::size_t receiver, const Air& air, Time at) {
  first(sender).receivers.each([&](std::size_t to) {
    if (to != receiver) return false;
    ++count(sender, Fate::delivered);
    put_delivery(sender, to, air, at);
    return true;
  });
}

// The copies of one broadcast share their payload in the report.
void Post::put_delivery(std::size_t sender, std::size_t to, const Air& air, Time at) {
  const Message& message = first(sender);
  const bool is_first = report_.deliveries.empty() || report_.deliveries.back().from != sender ||
                        report_.deliveries.back().received != at;
  if (is_first) report_.payloads.push_back(message.payload);
  report_.deliveries.push_back(
      {sender, to, message.asked, at, air.rssi(to), air.ratio(to), report_.payloads.size() - 1});
}

void Post::settle(std::size_t sender, Message& message, Fate fate) {
  message.receivers.each([&](std::size_t) {
    ++count(sender, fate);
    return true;
  });
}

void Post::save(Writer& out) const {
  out.put(queues_.size());
  for (const auto& queue : queues_) {
    out.put(queue.size());
    for (const Message& message : queue) {
      out.put(message.asked), out.put(message.to), out.put(message.frame);
      out.put_text(message.payload);
      message.receivers.save(out);
    }
  }
}

void Post::load(Reader& in) {
  queues_.resize(in.get<std::size_t>());
  for (auto& queue : queues_) {
    queue.resize(in.get<std::size_t>());
    for (Message& message : queue) {
      in.get(message.asked), in.get(message.to), in.get(message.frame);
      message.payload = in.text();
      message.receivers.load(in);
    }
  }
}

}  // namespace muster::packets
