#include "medium.hpp"

#include <algorithm>

#include "medium/state.hpp"

namespace muster::wifi {
namespace {

using medium::Frame;
using medium::never;
using medium::nothing;

// Order of simultaneous events: frames end, requests come, stations send, earlier begins are detected.
enum Kind {
  frame_ends,
  request_comes,
  station_is_due,
  ack_is_due,
  wait_ends,
  frame_is_noticed,
  reservation_ends,
  jammer_switches
};

// Detects a preamble down to 4 dB below noise and interference, at the end of the detection time: the strongest of
// those that begin within it (as ns-3 3.37 has it).
const double found_above = std::pow(10, 0.4);

// aRxPHYStartDelay: a sender waits this long, a SIFS and a slot for an acknowledgement to begin.
constexpr Time found_after = 20 * microsecond;

std::vector<medium::Format> formats() {
  static const std::vector<medium::BitLaw> laws = [] {
    std::vector<medium::BitLaw> made;
    for (const Rate& rate : rates) made.emplace_back([&](double ratio) { return bit_error_rate(rate, ratio); });
    return made;
  }();
  std::vector<medium::Format> result;
  for (std::size_t i = 0; i < rates.size(); ++i) {
    medium::Format format;
    format.head_law = &laws[0];
    format.head_from = preamble;
    format.head_until = preamble + signal_field;
    format.head_bits = 24.0 / static_cast<double>(signal_field);
    format.body_law = &laws[i];
    format.body_bits = 1e-3 * rates[i].mbit;
    format.tail = extension;
    result.push_back(format);
  }
  return result;
}

}  // namespace

Medium::Medium(const Stream& random) : random_(random), air_(random.of(key_of("bits")), formats()) {}

// ---- Time ---------------------------------------------------------------------------------------------------------

const Report& Medium::run(Time since, Time until, const Channel& channel, const Settings& settings) {
  settings_ = settings;
  channel_ = &channel;
  stations_.resize(channel.radios);
  air_.enter(channel, {settings.noise, found_above, detection, found_above, band_of(settings.channel)});
  post_.open(channel);
  for (std::size_t i = 0; i < stations_.size(); ++i) {
    if (channel.alive[i]) continue;
    const std::uint64_t draws = stations_[i].draws;
    stations_[i] = {};
    stations_[i].draws = draws;
    air_.forget(i);
  }
  agenda_.clear(until);
  fill_agenda(since);
  look_for_jammers(since);
  agenda_.begin();
  while (!agenda_.empty()) handle(agenda_.take());
  return post_.close();
}

void Medium::fill_agenda(Time since) {
  const auto put = [&](Time at, int kind, std::uint64_t which) {
    if (at >= since) agenda_.put(at, kind, which);
  };
  for (const Frame& frame : air_.frames()) {
    put(frame.begin + detection, frame_is_noticed, frame.id);
    put(frame.end, frame_ends, frame.id);
  }
  for (std::size_t i = 0; i < post_.requests().size(); ++i) put(post_.requests()[i].at, request_comes, i);
  for (std::size_t i = 0; i < stations_.size(); ++i) {
    put(stations_[i].due, station_is_due, 0);
    put(stations_[i].ack_due, ack_is_due, i);
    put(stations_[i].timeout, wait_ends, i);
    if (i == 0 || stations_[i].reserved != stations_[i - 1].reserved) put(stations_[i].reserved, reservation_ends, 0);
  }
}

// Jammers may have come, moved or gone since the last run. While frames are in the air, only the jammers' own power
// counts, since frames take time to be detected.
void Medium::look_for_jammers(Time since) {
  const auto& frames = air_.frames();
  const bool is_idle = std::none_of(frames.begin(), frames.end(), [&](const Frame& f) { return f.end > since; });
  if (!channel_->jammers.empty()) air_.hear(since);
  for (std::size_t i = 0; i < stations_.size(); ++i)
    if (is_idle || air_.jammed(i, since, since + 1) >= settings_.busy) look(i, since);
  agenda_.put(air_.next_switch(since), jammer_switches, 0);
}

void Medium::handle(const medium::Event& event) {
  const Time at = event.at;
  switch (event.kind()) {
    case frame_ends:
      return end_frame(event.number(), at);
    case request_comes:
      if (post_.take(event.number(), settings_.queue)) start(post_.requests()[event.number()].from, at);
      return;
    case station_is_due:
      return send_due(at);
    case ack_is_due:
      if (stations_[event.number()].ack_due == at) send_ack(event.number(), at);
      return;
    case wait_ends:
      if (stations_[event.number()].timeout == at) end_wait(event.number(), at);
      return;
    case frame_is_noticed:
      air_.drop_weak(event.number(), at, found_above);
      return look_all(at);
    case jammer_switches:
      air_.hear(at);
      agenda_.put(air_.next_switch(at), jammer_switches, 0);
      return look_all(at);
    default:
      look_all(at);
  }
}

// ---- Access -------------------------------------------------------------------------------------------------------

int Medium::draw_slots(std::size_t number) {
  Station& station = stations_[number];
  return static_cast<int>(random_.of(channel_->keys[number]).uniform(station.draws++) * (station.window + 1));
}

// Starts with a first message, perhaps while backoff after the last one is still running.
void Medium::start(std::size_t number, Time at) {
  Station& station = stations_[number];
  station.phase = Phase::contending;
  if (station.is_busy) {
    if (station.slots == 0) station.slots = draw_slots(number);
    return;
  }
  if (slots_end(station) <= at) {
    station.slots = 0;
    station.counts_from = at;
  }
  station.due = slots_end(station);
  agenda_.put(station.due, station_is_due, 0);
}

// Updates a station's view of the channel.
void Medium::look(std::size_t number, Time at) {
  Station& station = stations_[number];
  const bool is_busy = station.phase == Phase::sending || station.sends_ack || station.reserved > at ||
                       air_.power(number) >= settings_.busy || air_.listens_to(number) != nothing;
  if (is_busy == station.is_busy) return;
  is_busy ? freeze(number, at) : resume(number, at);
}

void Medium::look_all(Time at) {
  for (std::size_t i = 0; i < stations_.size(); ++i) look(i, at);
}

void Medium::freeze(std::size_t number, Time at) {
  Station& station = stations_[number];
  station.is_busy = true;
  if (at > station.counts_from)
    station.slots = std::max(0, station.slots - static_cast<int>((at - station.counts_from) / settings_.slot));
  station.due = never;
}

void Medium::resume(std::size_t number, Time at) {
  Station& station = stations_[number];
  station.is_busy = false;
  station.counts_from = at + (station.heard_wrong ? eifs() : difs());
  if (station.phase != Phase::contending) return;
  station.due = slots_end(station);
  agenda_.put(station.due, station_is_due, 0);
}

// Sends from all stations whose slots end now: none of them could detect the others.
void Medium::send_due(Time at) {
  for (std::size_t i = 0; i < stations_.size(); ++i) {
    Station& station = stations_[i];
    if (station.due != at) continue;
    const medium::Message& message = post_.first(i);
    station.due = never;
    station.slots = 0;
    station.phase = Phase::sending;
    station.is_busy = true;
    const std::size_t size = frame_size(message.size, message.frame);
    put_on_air(i, at, air_time(size, rates[settings_.rate]), settings_.rate, nothing, message.to);
  }
}

void Medium::send_ack(std::size_t number, Time at) {
  Station& station = stations_[number];
  station.ack_due = never;
  station.sends_ack = true;
  look(number, at);
  const Rate& rate = rates[settings_.rate];
  put_on_air(number, at, ack_time(rate), rate_of(rate.ack_mbit), station.ack_of, station.ack_to);
}

void Medium::put_on_air(std::size_t number, Time at, Time length, std::size_t format, std::uint64_t ack_of,
                        std::size_t to) {
  air_.deafen(number, never);
  const Frame& frame = air_.begin(number, at, length, format, ack_of, to, 0);
  if (ack_of == nothing) stations_[number].sent = frame.id;
  agenda_.put(at + detection, frame_is_noticed, frame.id);
  agenda_.put(frame.end, frame_ends, frame.id);
}

// ---- Frames -------------------------------------------------------------------------------------------------------

void Medium::end_frame(std::uint64_t id, Time at) {
  const Frame frame = air_.frame(id);
  for (std::size_t i = 0; i < stations_.size(); ++i)
    if (air_.listens_to(i) == id) stations_[i].heard_wrong = true;  // unless it is whole
  const std::vector<Heard>& heard = air_.end(frame);
  for (std::size_t i = 0; i < stations_.size(); ++i)
    if (heard[i] == Heard::whole) stations_[i].heard_wrong = false;
  Station& sender = stations_[frame.sender];
  const bool is_ack = frame.ack_of != nothing;
  if (is_ack ? sender.sends_ack : sender.phase == Phase::sending && sender.sent == id) {  // otherwise it has left since
    air_.deafen(frame.sender, at);
    sender.heard_wrong = false;
    if (is_ack)
      sender.sends_ack = false;
    else
      end_data(frame, heard, at);
  }
  if (is_ack) {
    const Station& waits = stations_[frame.to];
    const bool is_its_own = waits.phase == Phase::awaiting_ack && waits.sent == frame.ack_of;
    if (is_its_own && heard[frame.to] == Heard::whole) go_on_with_message(frame.to);
  }
  look_all(at);
}

void Medium::end_data(const Frame& frame, const std::vector<Heard>& heard, Time at) {
  if (frame.to != everyone) return end_unicast(frame, heard, at);
  if (post_.is_last_frame(frame.sender))
    post_.last_frame_heard(frame.sender, heard, air_, at);
  else
    post_.frame_heard(frame.sender, heard);
  go_on_with_message(frame.sender);
}

void Medium::end_unicast(const Frame& frame, const std::vector<Heard>& heard, Time at) {
  Station& sender = stations_[frame.sender];
  const bool arrived = heard[frame.to] == Heard::whole;
  if (!arrived)
    sender.last_loss = medium::fate_of(heard[frame.to]);
  else if (post_.is_last_frame(frame.sender))
    post_.deliver(frame.sender, frame.to, air_, at);
  sender.arrived |= arrived;
  if (!settings_.acknowledged) {
    if (!arrived) post_.settle(frame.sender, sender.last_loss);
    return go_on_with_message(frame.sender);
  }
  sender.phase = Phase::awaiting_ack;
  sender.timeout = at + sifs + settings_.slot + found_after;
  agenda_.put(sender.timeout, wait_ends, frame.sender);
  const Time reserved = at + sifs + ack_time(rates[settings_.rate]);
  for (std::size_t i = 0; i < stations_.size(); ++i) {
    if (heard[i] != Heard::whole || i == frame.to) continue;
    stations_[i].reserved = std::max(stations_[i].reserved, reserved);
  }
  agenda_.put(reserved, reservation_ends, 0);
  Station& receiver = stations_[frame.to];
  if (!arrived || receiver.ack_due != never || receiver.sends_ack) return;
  receiver.ack_of = frame.id;
  receiver.ack_to = frame.sender;
  receiver.ack_due = at + sifs;
  agenda_.put(receiver.ack_due, ack_is_due, frame.to);
}

// An acknowledgement being received by now may still arrive.
void Medium::end_wait(std::size_t number, Time at) {
  Station& station = stations_[number];
  station.timeout = never;
  if (const std::uint64_t heard = air_.listens_to(number); heard != nothing) {
    station.timeout = air_.frame(heard).end + 1;
    return agenda_.put(station.timeout, wait_ends, number);
  }
  if (++station.tries > settings_.retries) {
    post_.settle(number, station.arrived ? DeliveryOutcome::no_ack : station.last_loss);
    end_message(number);
  } else {
    compete(number, std::min(2 * station.window + 1, most_window));
  }
  if (station.is_busy) return;
  resume(number, at);
}

// ---- Messages -----------------------------------------------------------------------------------------------------

void Medium::go_on_with_message(std::size_t number) {
  if (post_.is_last_frame(number)) return end_message(number);
  ++post_.first(number).frame;
  stations_[number].tries = 0;
  stations_[number].arrived = false;
  compete(number, least_window);
}

void Medium::end_message(std::size_t number) {
  post_.drop_first(number);
  stations_[number].tries = 0;
  stations_[number].arrived = false;
  compete(number, least_window);
  if (!post_.is_waiting(number)) stations_[number].phase = Phase::idle;
}

// After every frame a station backs off, whether it has another one or not.
void Medium::compete(std::size_t number, int window) {
  Station& station = stations_[number];
  station.timeout = never;
  station.window = window;
  station.slots = draw_slots(number);
  station.phase = Phase::contending;
}

// ---- State --------------------------------------------------------------------------------------------------------

namespace {

// Lists a record's members, for both directions.
constexpr auto fields = [](auto&& field, auto& s) {
  field(s.phase), field(s.sends_ack), field(s.is_busy), field(s.heard_wrong), field(s.slots), field(s.window);
  field(s.tries), field(s.counts_from), field(s.due), field(s.timeout), field(s.reserved), field(s.sent);
  field(s.arrived), field(s.last_loss), field(s.ack_due), field(s.ack_of), field(s.ack_to), field(s.draws);
};

}  // namespace

std::string Medium::save() const {
  medium::Writer out;
  medium::save(out, air_, post_, stations_, fields);
  return out.take();
}

void Medium::load(std::string_view bytes) {
  *this = Medium(random_);
  if (bytes.empty()) return;
  medium::Reader in(bytes);
  medium::load(in, air_, post_, stations_, fields);
}

}  // namespace muster::wifi
