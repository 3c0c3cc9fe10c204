#include "medium.hpp"

#include <algorithm>
#include <functional>

#include "bytes.hpp"

namespace muster::lrwpan {
namespace {

enum Kind { frame_ends, request_comes, phase_ends, ack_phase_ends };

// A receiver finds a preamble that is up to 5 dB below noise and interference (as ns-3 3.37 has it).
const double found_above = std::pow(10, -0.5);

}  // namespace

// ---- Time ---------------------------------------------------------------------------------------------------------

Report Medium::run(Time since, Time until, const Channel& channel, const Settings& settings) {
  Report report;
  settings_ = settings;
  report.fates.resize(channel.radios);
  channel_ = &channel;
  report_ = &report;
  until_ = until;
  events_.clear();
  radios_.resize(channel.radios);
  forget_the_gone();
  for (const Frame& frame : air_)
    if (frame.end >= since) schedule(frame.end, frame_ends, frame.id);
  for (std::size_t i = 0; i < requests_.size(); ++i) schedule(requests_[i].at, request_comes, i);
  for (std::size_t i = 0; i < radios_.size(); ++i) {
    schedule(radios_[i].due, phase_ends, i);
    schedule(radios_[i].ack_due, ack_phase_ends, i);
  }
  while (!events_.empty()) {
    std::pop_heap(events_.begin(), events_.end(), std::greater<>());
    const Event event = events_.back();
    events_.pop_back();
    handle(event);
  }
  requests_.clear();
  return report;
}

// What lies beyond the run is scheduled anew by the next one.
void Medium::schedule(Time at, int kind, std::size_t which) {
  if (at >= until_) return;
  events_.push_back({at, kind, which});
  std::push_heap(events_.begin(), events_.end(), std::greater<>());
}

void Medium::handle(const Event& event) {
  switch (event.kind) {
    case frame_ends:
      return end_frame(event.which, event.at);
    case request_comes:
      return take_request(requests_[event.which]);
    case phase_ends:
      if (radios_[event.which].due == event.at) end_phase(event.which, event.at);  // else it ended early
      return;
    default:
      if (radios_[event.which].ack_due == event.at) end_ack_phase(event.which, event.at);
  }
}

void Medium::wait(std::size_t radio, Phase phase, Time until) {
  radios_[radio].phase = phase;
  radios_[radio].due = until;
  schedule(until, phase_ends, radio);
}

void Medium::wait_with_ack(std::size_t radio, Phase phase, Time until) {
  radios_[radio].ack_phase = phase;
  radios_[radio].ack_due = until;
  schedule(until, ack_phase_ends, radio);
}

double Medium::draw(std::size_t radio) { return random_.of(channel_->keys[radio]).uniform(radios_[radio].draws++); }

// ---- Access -------------------------------------------------------------------------------------------------------

void Medium::ask(Time at, std::size_t from, std::size_t to, std::string payload) {
  requests_.push_back({at, from, to, std::move(payload)});
}

void Medium::take_request(Request& request) {
  const auto& alive = channel_->alive;
  Message message{request.at, request.to, std::move(request.payload), std::vector<Fate>(radios_.size(), Fate::count)};
  const auto address = [&](std::size_t to) {
    message.fates[to] = Fate::under_way;
    ++report_->fates[request.from][static_cast<std::size_t>(Fate::under_way)];
  };
  if (request.to != everyone) {
    address(request.to);
  } else {
    for (std::size_t i = 0; i < radios_.size(); ++i)
      if (i != request.from && alive[i]) address(i);
  }
  Radio& radio = radios_[request.from];
  Fate refused = Fate::under_way;
  if (request.to == request.from) refused = Fate::no_link;
  if (radio.queue.size() > settings_.queue) refused = Fate::queue_full;
  if (!alive[request.from]) refused = Fate::gone;
  if (refused != Fate::under_way) {
    for (std::size_t i = 0; i < radios_.size(); ++i) settle(request.from, message, i, refused);
    return;
  }
  radio.queue.push_back(std::move(message));
  if (radio.queue.size() == 1) compete(request.from, request.at);
}

void Medium::compete(std::size_t radio, Time at) {
  radios_[radio].backoffs = 0;
  radios_[radio].exponent = least_exponent;
  back_off(radio, std::max(at, radios_[radio].spaced));
}

void Medium::back_off(std::size_t radio, Time from) {
  const auto periods = static_cast<Time>(draw(radio) * (1 << radios_[radio].exponent));
  wait(radio, Phase::backing_off, from + periods * unit_backoff + cca_window);
}

void Medium::assess(std::size_t number, Time at) {
  Radio& radio = radios_[number];
  if (radio.ack_phase == Phase::idle && !is_busy(number, at)) {
    radio.lock = nothing;
    wait(number, Phase::turning, at + turnaround);
    return;
  }
  radio.exponent = std::min(radio.exponent + 1, most_exponent);
  if (++radio.backoffs > most_backoffs)
    give_up(number, Fate::no_access, at);
  else
    back_off(number, at);
}

double Medium::power_at(std::size_t radio, Time at) const {
  double sum = 0;
  for (const Frame& frame : air_)
    if (frame.begin <= at && at < frame.end) sum += channel_->from_to(frame.sender, radio);
  return sum;
}

bool Medium::is_busy(std::size_t radio, Time at) const {
  const Time since = at - cca_window;
  if (settings_.cca == Cca::standard) {
    double energy = 0;  // mW ns
    for (const Frame& frame : air_) {
      const Time overlap = std::min(frame.end, at) - std::max(frame.begin, since);
      if (overlap > 0) energy += channel_->from_to(frame.sender, radio) * static_cast<double>(overlap);
    }
    return energy >= settings_.busy * static_cast<double>(cca_window);
  }
  if (power_at(radio, at - 1) >= settings_.busy) return true;
  return settings_.cca == Cca::ns3 && std::any_of(air_.begin(), air_.end(), [&](const Frame& frame) {
           return frame.begin > since && frame.begin < at && power_at(radio, frame.begin) >= settings_.busy;
         });
}

void Medium::end_phase(std::size_t number, Time at) {
  Radio& radio = radios_[number];
  switch (radio.phase) {
    case Phase::backing_off:
      return assess(number, at);
    case Phase::turning:
      wait(number, Phase::sending, never);
      return begin_frame(number, at, air_time(frame_size(radio.queue.front().payload.size(), radio.frame)), nothing,
                         everyone);
    case Phase::settling:
      if (radio.queue.front().to != everyone && settings_.acknowledged)
        return wait(number, Phase::awaiting_ack, at - turnaround + ack_wait);
      return go_on_with_message(number, at);
    case Phase::awaiting_ack:
      if (++radio.tries > settings_.retries) return give_up(number, Fate::no_ack, at);
      return compete(number, at);
    default:
      return;
  }
}

void Medium::end_ack_phase(std::size_t number, Time at) {
  Radio& radio = radios_[number];
  if (radio.ack_phase == Phase::turning) {
    wait_with_ack(number, Phase::sending, never);
    begin_frame(number, at, air_time(ack_frame), radio.ack_of, radio.ack_to);
  } else {
    wait_with_ack(number, Phase::idle, never);
  }
}

// ---- Frames -------------------------------------------------------------------------------------------------------

bool Medium::listens(const Radio& radio) {
  return radio.ack_phase == Phase::idle && radio.phase != Phase::turning && radio.phase != Phase::sending &&
         radio.phase != Phase::settling;
}

void Medium::begin_frame(std::size_t sender, Time at, Time length, std::uint64_t ack_of, std::size_t ack_to) {
  for (std::size_t i = 0; i < radios_.size(); ++i) hear(i, at);
  air_.erase(std::remove_if(air_.begin(), air_.end(), [&](const Frame& f) { return f.end < at - cca_window; }),
             air_.end());
  const Frame frame{++frames_, sender, at, at + length, ack_of, ack_to};
  radios_[sender].lock = nothing;
  for (std::size_t i = 0; i < radios_.size(); ++i) {
    Radio& radio = radios_[i];
    if (i == sender || !channel_->alive[i] || radio.lock != nothing || !listens(radio)) continue;
    const double rssi = channel_->rssi[sender * channel_->radios + i];
    if (std::isnan(rssi)) continue;
    if (channel_->from_to(sender, i) <= found_above * (power_at(i, at) + settings_.noise)) continue;
    radio.lock = frame.id;
    radio.rssi = rssi;
    radio.log_whole = 0;
    radio.disturbed = false;
    radio.heard_until = at;
  }
  air_.push_back(frame);
  schedule(frame.end, frame_ends, frame.id);
}

// The bits since it last heard, all under the same frames in the air.
void Medium::hear(std::size_t number, Time until) {
  Radio& radio = radios_[number];
  if (radio.lock == nothing || radio.heard_until == until) return;
  double signal = 0, others = 0;
  for (const Frame& frame : air_) {
    if (frame.begin > radio.heard_until || frame.end < until) continue;
    (frame.id == radio.lock ? signal : others) += channel_->from_to(frame.sender, number);
  }
  const Time bits = (until - radio.heard_until + bit - 1) / bit;
  radio.log_whole += static_cast<double>(bits) * std::log1p(-bit_error_rate(signal / (others + settings_.noise)));
  radio.disturbed |= others > 0;
  radio.heard_until = until;
}

Fate Medium::heard_by(std::size_t number, const Frame& frame) {
  Radio& radio = radios_[number];
  const double power = channel_->from_to(frame.sender, number);
  if (radio.lock == frame.id) {
    radio.lock = nothing;
    if (draw(number) < std::exp(radio.log_whole)) return Fate::delivered;
    return radio.disturbed ? Fate::collided : Fate::too_weak;
  }
  if (!channel_->alive[number]) return Fate::gone;
  if (power == 0) return Fate::no_link;
  const bool is_heard = !std::isnan(channel_->rssi[frame.sender * channel_->radios + number]);
  const bool strong = is_heard && power > found_above * settings_.noise;
  return strong ? Fate::collided : Fate::too_weak;
}

void Medium::end_frame(std::uint64_t id, Time at) {
  const Frame frame = *std::find_if(air_.begin(), air_.end(), [&](const Frame& f) { return f.id == id; });
  std::vector<Fate> heard(radios_.size(), Fate::count);
  for (std::size_t i = 0; i < radios_.size(); ++i) {
    hear(i, at);
    if (i != frame.sender) heard[i] = heard_by(i, frame);
  }
  Radio& sender = radios_[frame.sender];
  if (frame.ack_of != nothing) {
    if (sender.ack_phase == Phase::sending) wait_with_ack(frame.sender, Phase::settling, at + turnaround);
    const Radio& waits = radios_[frame.ack_to];
    const bool is_its_own = waits.phase == Phase::awaiting_ack && waits.sent == frame.ack_of;
    if (is_its_own && heard[frame.ack_to] == Fate::delivered) go_on_with_message(frame.ack_to, at);
    return;
  }
  if (sender.phase != Phase::sending) return;  // it has left meanwhile
  sender.sent = id;
  sender.spaced = at + (frame.end - frame.begin > air_time(18) ? long_spacing : short_spacing);
  wait(frame.sender, Phase::settling, at + turnaround);
  if (const std::size_t to = sender.queue.front().to; to == everyone)
    end_broadcast(frame.sender, at, heard);
  else
    end_unicast(frame, at, heard[to]);
}

void Medium::end_broadcast(std::size_t sender, Time at, const std::vector<Fate>& heard) {
  Message& message = radios_[sender].queue.front();
  for (std::size_t i = 0; i < message.fates.size(); ++i) {
    if (message.fates[i] != Fate::under_way) continue;
    if (heard[i] != Fate::delivered)
      settle(sender, message, i, heard[i]);
    else if (is_last_frame(radios_[sender]))
      deliver(sender, message, i, at);
  }
}

void Medium::end_unicast(const Frame& frame, Time at, Fate heard) {
  Radio& sender = radios_[frame.sender];
  Message& message = sender.queue.front();
  if (heard != Fate::delivered) {
    sender.last_loss = heard;
    if (!settings_.acknowledged) settle(frame.sender, message, message.to, heard);
    return;
  }
  if (is_last_frame(sender)) deliver(frame.sender, message, message.to, at);
  sender.arrived = true;
  Radio& receiver = radios_[message.to];
  if (!settings_.acknowledged || receiver.ack_phase != Phase::idle) return;
  receiver.ack_of = frame.id;
  receiver.ack_to = frame.sender;
  wait_with_ack(message.to, Phase::turning, at + turnaround);
}

// ---- Messages -----------------------------------------------------------------------------------------------------

bool Medium::is_last_frame(const Radio& radio) const {
  return radio.frame + 1 == frames_of(radio.queue.front().payload.size());
}

void Medium::go_on_with_message(std::size_t sender, Time at) {
  Radio& radio = radios_[sender];
  if (is_last_frame(radio)) return end_message(sender, at);
  ++radio.frame;
  radio.tries = 0;
  radio.arrived = false;
  compete(sender, at);
}

// For lack of acknowledgements, though the frame may have arrived; or of a free channel.
void Medium::give_up(std::size_t sender, Fate why, Time at) {
  Radio& radio = radios_[sender];
  Message& message = radio.queue.front();
  if (why == Fate::no_ack && !radio.arrived) why = radio.last_loss;
  for (std::size_t i = 0; i < message.fates.size(); ++i) settle(sender, message, i, why);
  end_message(sender, at);
}

void Medium::end_message(std::size_t sender, Time at) {
  Radio& radio = radios_[sender];
  radio.queue.pop_front();
  radio.frame = 0;
  radio.tries = 0;
  radio.arrived = false;
  wait(sender, Phase::idle, never);
  if (!radio.queue.empty()) compete(sender, at);
}

// Each copy once.
void Medium::settle(std::size_t sender, Message& message, std::size_t to, Fate fate) {
  if (message.fates[to] != Fate::under_way) return;
  message.fates[to] = fate;
  ++report_->fates[sender][static_cast<std::size_t>(fate)];
}

void Medium::deliver(std::size_t sender, Message& message, std::size_t to, Time at) {
  if (message.fates[to] != Fate::under_way) return;
  report_->deliveries.push_back({sender, to, message.asked, at, radios_[to].rssi, message.payload});
  settle(sender, message, to, Fate::delivered);
}

void Medium::forget_the_gone() {
  for (std::size_t i = 0; i < radios_.size(); ++i) {
    if (channel_->alive[i]) continue;
    for (Message& message : radios_[i].queue)
      for (std::size_t to = 0; to < message.fates.size(); ++to) settle(i, message, to, Fate::gone);
    const std::uint64_t draws = radios_[i].draws;
    radios_[i] = {};
    radios_[i].draws = draws;
  }
}

// ---- State --------------------------------------------------------------------------------------------------------

namespace {

// One list of what a record holds, for both directions.
template <class Archive, class Record>
void put_radio(Archive&& field, Record& r) {
  field(r.frame), field(r.phase), field(r.due), field(r.spaced), field(r.backoffs), field(r.exponent), field(r.tries);
  field(r.sent), field(r.arrived), field(r.last_loss), field(r.ack_phase), field(r.ack_due), field(r.ack_of);
  field(r.ack_to), field(r.lock), field(r.rssi), field(r.log_whole), field(r.disturbed), field(r.heard_until),
      field(r.draws);
}

template <class Archive, class Record>
void put_frame(Archive&& field, Record& f) {
  field(f.id), field(f.sender), field(f.begin), field(f.end), field(f.ack_of), field(f.ack_to);
}

}  // namespace

std::string Medium::save() const {
  Writer out;
  const auto put = [&](const auto& value) { out.put(value); };
  out.put(frames_);
  out.put(air_.size());
  for (const Frame& frame : air_) put_frame(put, frame);
  out.put(radios_.size());
  for (const Radio& radio : radios_) {
    put_radio(put, radio);
    out.put(radio.queue.size());
    for (const Message& message : radio.queue) {
      out.put(message.asked), out.put(message.to);
      out.put_text(message.payload);
      out.put(message.fates.size());
      for (const Fate fate : message.fates) out.put(fate);
    }
  }
  return out.take();
}

void Medium::load(std::string_view bytes) {
  *this = Medium(random_);
  if (bytes.empty()) return;
  Reader in(bytes);
  const auto get = [&](auto& value) { in.get(value); };
  in.get(frames_);
  air_.resize(in.get<std::size_t>());
  for (Frame& frame : air_) put_frame(get, frame);
  radios_.resize(in.get<std::size_t>());
  for (Radio& radio : radios_) {
    put_radio(get, radio);
    radio.queue.resize(in.get<std::size_t>());
    for (Message& message : radio.queue) {
      in.get(message.asked), in.get(message.to);
      message.payload = in.text();
      message.fates.resize(in.get<std::size_t>());
      for (Fate& fate : message.fates) in.get(fate);
    }
  }
}

}  // namespace muster::lrwpan
