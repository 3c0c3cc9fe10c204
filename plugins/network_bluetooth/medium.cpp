#include "medium.hpp"

#include <algorithm>

#include "medium/state.hpp"

namespace muster::bluetooth {
namespace {

using medium::Frame;
using medium::never;
using medium::nothing;

// Order of simultaneous events: frames end, requests come, packets expire, slaves answer, the master sends.
enum Kind { frame_ends, request_comes, packet_expires, slave_answers, master_turns };

// A packet is detected if its header has a chance.
constexpr double found_above = 1;

// One for each packet type, by its number; a packet without payload is as long as the first.
std::vector<medium::Format> formats() {
  static const medium::BitLaw body(bit_error_rate), head(header_error_rate);
  medium::Format format;
  format.head_law = &head;
  format.head_from = access_code;
  format.head_until = bare;
  format.head_bits = 18.0 / static_cast<double>(header);
  format.body_law = &body;
  format.body_bits = 1.0 / static_cast<double>(bit);
  return {types.size(), format};
}

// The master's next possible start, from this time on.
Time turn_from(Time at) { return (at + turn - 1) / turn * turn; }

}  // namespace

Medium::Medium(const Stream& random) : random_(random), air_(random.of(key_of("bits")), formats()) {}

// ---- Time ---------------------------------------------------------------------------------------------------------

const Report& Medium::run(Time since, Time until, const Channel& channel, const Settings& settings) {
  settings_ = settings;
  channel_ = &channel;
  radios_.resize(channel.radios);
  choose_master();
  const auto& frames = air_.frames();
  const medium::Band band = frames.empty() ? medium::Band{} : band_of(channel_at(frames.back().begin));
  air_.enter(channel, {settings.noise, found_above, 0, found_above, band});
  look_who_is_there();
  post_.open(channel);
  agenda_.clear(until);
  for (const Frame& frame : frames)
    if (frame.end >= since) agenda_.put(frame.end, frame_ends, frame.id);
  for (std::size_t i = 0; i < post_.requests().size(); ++i) agenda_.put(post_.requests()[i].at, request_comes, i);
  wake(since);
  for (std::size_t i = 0; i < radios_.size(); ++i) {
    if (post_.is_waiting(i) && settle_unreachable(i)) begin_message(i, since);  // a radio left
    agenda_.put(radios_[i].expires, packet_expires, i);
    agenda_.put(radios_[i].answers, slave_answers, i);
  }
  agenda_.begin();
  while (!agenda_.empty()) handle(agenda_.take());
  return post_.close();
}

void Medium::choose_master() {
  is_there_ = channel_->alive;
  for (const medium::Jammer& jammer : channel_->jammers) is_there_[jammer.radio] = false;
  std::size_t& master = settings_.master;
  if (master == Settings::first_there) {
    const auto first = std::find(is_there_.begin(), is_there_.end(), true);
    master = first == is_there_.end() ? 0 : static_cast<std::size_t>(first - is_there_.begin());
  } else if (channel_->alive[master] && !is_there_[master]) {
    throw JammingMaster("jams, so that it is no radio of the piconet", members());
  }
  if (master < radios_.size()) radios_[master].answers = never;  // it owes none, even if it was a slave until now
}

std::vector<std::size_t> Medium::members() const {
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < is_there_.size(); ++i) {
    if (is_there_[i]) result.push_back(i);
  }
  return result;
}

void Medium::look_who_is_there() {
  const auto there = std::count(is_there_.begin(), is_there_.end(), true);
  if (there > 1 + most_slaves)
    throw TooManyRadios(std::to_string(there) + " radios; a piconet has one master and at most " +
                            std::to_string(most_slaves) + " slaves",
                        members());
  for (std::size_t i = 0; i < radios_.size(); ++i) {
    if (is_there_[i]) continue;
    radios_[i] = {};
    air_.forget(i);
  }
}

void Medium::handle(const medium::Event& event) {
  switch (event.kind()) {
    case frame_ends:
      return end_frame(event.number(), event.at);
    case request_comes:
      if (post_.take(event.number(), settings_.queue)) begin_message(post_.requests()[event.number()].from, event.at);
      return;
    case packet_expires:
      if (radios_[event.number()].expires == event.at) expire(event.number(), event.at);
      return;
    case slave_answers:
      if (radios_[event.number()].answers == event.at) answer(event.number(), event.at);
      return;
    default:
      if (turn_ == event.at) take_turn(event.at);
  }
}

// ---- Access -------------------------------------------------------------------------------------------------------

// Pseudo-random hop sequence of the master, uniform over the channels.
int Medium::channel_at(Time at) const {
  const Stream hops = random_.of(key_of("hops")).of(channel_->keys[settings_.master]);
  return static_cast<int>(channels * hops.uniform(static_cast<std::uint64_t>(at / slot)));
}

// Sends to the slave that wants its turn and has waited longest.
void Medium::take_turn(Time at) {
  const std::size_t master = settings_.master;
  std::size_t next = everyone;
  Time wanted = never;
  for (std::size_t i = 0; i < radios_.size(); ++i) {
    const Time wants = wants_turn(i, at);
    wanted = std::min(wanted, wants);
    if (wants <= at && (next == everyone || radios_[i].addressed < radios_[next].addressed)) next = i;
  }
  if (next == everyone) return wait_for_turn(wanted == never ? never : turn_from(wanted));
  radios_[next].addressed = at;
  const std::size_t type = put_on_air(master, next == master ? everyone : next, at, radios_[next].heard);
  free_ = at + (types[type].slots + 1) * slot;
  wait_for_turn(free_);
}

// Time from which the radio wants a turn; the master's own turn is a broadcast.
Time Medium::wants_turn(std::size_t radio, Time at) const {
  const std::size_t master = settings_.master;
  if (!is_there_[radio] || !is_there_[master]) return never;
  if (has_for(master, radio == master ? everyone : radio)) return at;
  if (radio == master) return never;
  return at < radios_[radio].has_more_until ? at : radios_[radio].addressed + settings_.poll_interval;
}

void Medium::wait_for_turn(Time at) {
  turn_ = at;
  agenda_.put(at, master_turns, 0);
}

// Schedules the master's next decision as early as allowed.
void Medium::wake(Time at) { wait_for_turn(std::max(free_, turn_from(at))); }

void Medium::answer(std::size_t slave, Time at) {
  Radio& radio = radios_[slave];
  radio.answers = never;
  const std::size_t type = put_on_air(slave, settings_.master, at, radio.answers_to);
  free_ = at + types[type].slots * slot;
  wait_for_turn(free_);
}

// Sends data if there are any for the receiver, else a POLL or a NULL. Returns the packet's type.
std::size_t Medium::put_on_air(std::size_t from, std::size_t to, Time at, std::uint64_t ack_of) {
  const bool has_data = has_for(from, to);
  std::size_t type = dh1;
  Time length = bare;
  if (has_data) {
    const std::size_t size = std::min(types[settings_.largest].payload, rest(from));
    type = type_for(size, settings_.largest);
    length = air_time(type, size);
    radios_[from].carried = size;
  }
  air_.tune(at, band_of(channel_at(at)));
  const Frame& frame = air_.begin(from, at, length, type, ack_of, to, 0);
  agenda_.put(frame.end, frame_ends, frame.id);
  if (!has_data) return type;
  radios_[from].sent = frame.id;
  radios_[from].sent_until = frame.end;
  return type;
}

// ---- Frames -------------------------------------------------------------------------------------------------------

void Medium::end_frame(std::uint64_t id, Time at) {
  const Frame frame = air_.frame(id);
  const std::vector<Heard>& heard = air_.end(frame);
  if (!is_there_[frame.sender]) return;
  if (frame.to == everyone) {
    if (radios_[frame.sender].sent == id) end_broadcast(frame.sender, heard, at);
  } else if (frame.sender == settings_.master) {
    end_down(frame, heard[frame.to], at);
  } else {
    end_up(frame, heard[frame.to], at);
  }
}

// Broadcasts are sent once and not acknowledged.
void Medium::end_broadcast(std::size_t sender, const std::vector<Heard>& heard, Time at) {
  if (is_last_packet(sender))
    post_.last_frame_heard(sender, heard, air_, at);
  else
    post_.frame_heard(sender, heard);
  go_on_with_message(sender, at);
}

void Medium::end_down(const Frame& frame, Heard heard, Time at) {
  Radio& slave = radios_[frame.to];
  const bool bears_data = radios_[frame.sender].sent == frame.id;
  if (heard != Heard::whole) {
    slave.last_loss = medium::fate_of(heard);  // it would have been allowed to answer
    if (bears_data) radios_[frame.sender].last_loss = slave.last_loss;
    return;
  }
  if (bears_data) arrive(frame.sender, frame.to, at);
  acknowledge(frame.to, frame.ack_of, at);
  slave.answers = frame.begin + types[frame.format].slots * slot;
  slave.answers_to = frame.id;
  agenda_.put(slave.answers, slave_answers, frame.to);
}

void Medium::end_up(const Frame& frame, Heard heard, Time at) {
  Radio& slave = radios_[frame.sender];
  const bool bears_data = slave.sent == frame.id;
  if (heard != Heard::whole) {
    if (bears_data) slave.last_loss = medium::fate_of(heard);
    return;
  }
  slave.has_more_until = bears_data ? at + settings_.poll_interval : 0;
  if (bears_data) {
    slave.heard = frame.id;
    arrive(frame.sender, frame.to, at);
  }
  acknowledge(frame.to, frame.ack_of, at);
}

// Arrival at the one receiver, possibly a repetition.
void Medium::arrive(std::size_t from, std::size_t to, Time at) {
  if (is_last_packet(from)) post_.deliver(from, to, air_, at);
  radios_[from].arrived = true;
}

void Medium::acknowledge(std::size_t from, std::uint64_t frame, Time at) {
  if (frame != nothing && radios_[from].sent == frame) go_on_with_message(from, at);
}

void Medium::expire(std::size_t number, Time at) {
  Radio& radio = radios_[number];
  if (at < radio.sent_until) {  // a packet in the air may still arrive
    radio.expires = radio.sent_until;
    return agenda_.put(radio.expires, packet_expires, number);
  }
  post_.settle(number, radio.arrived ? DeliveryOutcome::no_ack : radio.last_loss);
  post_.drop_first(number);
  begin_message(number, at);
}

// ---- Messages -----------------------------------------------------------------------------------------------------

bool Medium::has_for(std::size_t from, std::size_t to) const {
  if (!post_.is_waiting(from)) return false;
  return from != settings_.master || post_.first(from).to == to;
}

// Octets of its first message not yet acknowledged.
std::size_t Medium::rest(std::size_t sender) const {
  return l2cap_header + post_.first(sender).size - radios_[sender].done;
}

// Slaves have no links to each other.
bool Medium::is_linked(std::size_t one, std::size_t other) const {
  return is_there_[one] && is_there_[other] && (one == settings_.master || other == settings_.master);
}

// Settles copies of the first message that no packet can reach. True if no receiver is left.
bool Medium::settle_unreachable(std::size_t sender) {
  std::vector<Heard> heard(radios_.size(), Heard::whole);
  for (std::size_t i = 0; i < heard.size(); ++i)
    if (!is_linked(sender, i)) heard[i] = channel_->alive[i] ? Heard::no_link : Heard::gone;
  post_.frame_heard(sender, heard);
  const std::size_t to = post_.first(sender).to;
  if (is_linked(sender, to == everyone ? settings_.master : to)) return false;
  post_.drop_first(sender);
  return true;
}

void Medium::begin_message(std::size_t sender, Time at) {
  while (post_.is_waiting(sender) && settle_unreachable(sender)) {
  }
  radios_[sender].done = 0;
  begin_packet(sender, at);
}

void Medium::begin_packet(std::size_t sender, Time at) {
  Radio& radio = radios_[sender];
  radio.sent = nothing;
  radio.sent_until = at;
  radio.arrived = false;
  radio.expires = post_.is_waiting(sender) && settings_.flush > 0 ? at + settings_.flush : never;
  agenda_.put(radio.expires, packet_expires, sender);
  if (sender == settings_.master && post_.is_waiting(sender)) wake(at);
}

void Medium::go_on_with_message(std::size_t sender, Time at) {
  if (!is_last_packet(sender)) {
    radios_[sender].done += radios_[sender].carried;
    return begin_packet(sender, at);
  }
  post_.drop_first(sender);
  begin_message(sender, at);
}

// ---- State --------------------------------------------------------------------------------------------------------

namespace {

// Lists a record's members, for both directions.
constexpr auto fields = [](auto&& field, auto& r) {
  field(r.done), field(r.carried), field(r.sent), field(r.sent_until), field(r.arrived), field(r.last_loss);
  field(r.expires), field(r.addressed), field(r.has_more_until), field(r.heard), field(r.answers), field(r.answers_to);
};

}  // namespace

std::string Medium::save() const {
  medium::Writer out;
  out.put(free_);
  medium::save(out, air_, post_, radios_, fields);
  return out.take();
}

void Medium::load(std::string_view bytes) {
  *this = Medium(random_);
  if (bytes.empty()) return;
  medium::Reader in(bytes);
  in.get(free_);
  medium::load(in, air_, post_, radios_, fields);
}

}  // namespace muster::bluetooth
