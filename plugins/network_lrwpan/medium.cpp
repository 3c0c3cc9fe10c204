#include "medium.hpp"

#include <algorithm>

#include "medium/state.hpp"

namespace muster::lrwpan {
namespace {

using medium::Frame;
using medium::never;
using medium::nothing;

// A receiver detects a preamble down to 5 dB below noise and interference (as ns-3 3.37 has it).
const double found_above = std::pow(10, -0.5);

medium::Format format() {
  static const medium::BitLaw law(bit_error_rate);
  medium::Format result;
  result.body_law = &law;
  result.body_bits = 1.0 / static_cast<double>(bit);
  return result;
}

}  // namespace

Medium::Medium(const Stream& random) : random_(random), air_(random.of(key_of("bits")), {format(), format()}) {}

// ---- Time ---------------------------------------------------------------------------------------------------------

const Report& Medium::run(Time since, Time until, const Channel& channel, const Settings& settings) {
  settings_ = settings;
  channel_ = &channel;
  radios_.resize(channel.radios);
  const bool captures = settings.capture > 0;
  air_.enter(channel, {settings.noise, found_above, captures ? never : 0, captures ? settings.capture : found_above,
                       band_of(settings.channel)});
  post_.open(channel);
  agenda_.clear(until);
  superframe_ = settings.beacon_order == no_beacons
                    ? Superframe()
                    : Superframe(settings.beacon_order, settings.superframe_order, settings.extended);
  for (std::size_t i = 0; i < radios_.size(); ++i) {
    if (channel.alive[i]) continue;
    const std::uint64_t draws = radios_[i].draws;
    radios_[i] = {};
    radios_[i].draws = draws;
    air_.forget(i);
  }
  for (const Frame& frame : air_.frames())
    if (frame.end >= since) agenda_.put(frame.end, frame_ends, frame.id);
  for (std::size_t i = 0; i < post_.requests().size(); ++i) agenda_.put(post_.requests()[i].at, request_comes, i);
  for (std::size_t i = 0; i < radios_.size(); ++i) {
    agenda_.put(radios_[i].due, phase_ends, i);
    agenda_.put(radios_[i].ack_due, ack_is_due, i);
  }
  enter_members(since);
  if (superframe_.exists()) put_superframes(since, until);
  agenda_.begin();
  while (!agenda_.empty()) handle(agenda_.take());
  return post_.close();
}

void Medium::handle(const medium::Event& event) {
  switch (event.kind()) {
    case frame_ends:
      return end_frame(event.number(), event.at);
    case request_comes:
      if (post_.take(event.number(), settings_.queue)) begin_message(post_.requests()[event.number()].from, event.at);
      return;
    case phase_ends:
      if (radios_[event.number()].due == event.at) end_phase(event.number(), event.at);  // otherwise it ended early
      return;
    case ack_is_due:
      if (radios_[event.number()].ack_due == event.at) send_ack(event.number(), event.at);
      return;
    default:
      handle_superframe(event.number(), event.at);
  }
}

void Medium::wait(std::size_t radio, Phase phase, Time until) {
  radios_[radio].phase = phase;
  radios_[radio].due = until;
  agenda_.put(until, phase_ends, radio);
}

void Medium::wait_with_ack(std::size_t radio, Phase phase, Time until) {
  radios_[radio].ack_phase = phase;
  radios_[radio].ack_due = until;
  agenda_.put(until, ack_is_due, radio);
}

// ---- Access -------------------------------------------------------------------------------------------------------

// Goes on to the first message that may be sent at all.
void Medium::begin_message(std::size_t sender, Time at) {
  radios_[sender].tries = 0;
  radios_[sender].arrived = false;
  for (; post_.is_waiting(sender); post_.drop_first(sender)) {
    const DeliveryOutcome why = refusal(sender);
    if (why == DeliveryOutcome::under_way) return compete(sender, at);
    post_.settle(sender, why);
  }
  wait(sender, Phase::idle, never);
}

void Medium::compete(std::size_t radio, Time at) {
  radios_[radio].backoffs = 0;
  radios_[radio].exponent = least_exponent;
  back_off(radio, std::max(at, radios_[radio].spaced));
}

Time Medium::backoff_periods(std::size_t number) {
  Radio& radio = radios_[number];
  const double drawn = random_.of(channel_->keys[number]).uniform(radio.draws++);
  return static_cast<Time>(drawn * (1 << radio.exponent));
}

void Medium::back_off(std::size_t number, Time from) {
  if (is_member(number)) return back_off_in_slots(number, from);
  wait(number, Phase::backing_off, from + backoff_periods(number) * unit_backoff + cca_window);
}

void Medium::assess(std::size_t number, Time at) {
  if (is_free(number, at))
    turn_round(number, at);
  else
    back_off_again(number, at);
}

void Medium::turn_round(std::size_t number, Time at) {
  air_.deafen(number, never);
  wait(number, Phase::turning, at + turnaround);
}

void Medium::back_off_again(std::size_t number, Time at) {
  Radio& radio = radios_[number];
  radio.exponent = std::min(radio.exponent + 1, most_exponent);
  if (++radio.backoffs > most_backoffs)
    give_up(number, DeliveryOutcome::no_access, at);
  else
    back_off(number, at);
}

// A radio that owes an acknowledgement, or has just sent one, senses a busy channel.
bool Medium::is_free(std::size_t radio, Time at) const {
  return radios_[radio].ack_phase == Phase::idle && !air_.is_deaf(radio, at) && !is_busy(radio, at);
}

bool Medium::is_busy(std::size_t radio, Time at) const {
  const Time since = at - cca_window;
  if (settings_.cca == Cca::standard) {
    double energy = air_.jammed(radio, since, at) * static_cast<double>(cca_window);  // mW ns
    for (const Frame& frame : air_.frames()) {
      const Time overlap = std::min(frame.end, at) - std::max(frame.begin, since);
      if (overlap > 0) energy += channel_->power_from(frame.sender)[radio] * static_cast<double>(overlap);
    }
    return energy >= settings_.busy * static_cast<double>(cca_window);
  }
  if (air_.power_at(radio, at - 1) >= settings_.busy) return true;
  if (settings_.cca == Cca::ns3 && air_.listens_to(radio) != medium::nothing) return true;
  const auto& frames = air_.frames();
  return settings_.cca == Cca::ns3 && std::any_of(frames.begin(), frames.end(), [&](const Frame& frame) {
           return frame.begin > since && frame.begin < at && air_.power_at(radio, frame.begin) >= settings_.busy;
         });
}

void Medium::end_phase(std::size_t number, Time at) {
  Radio& radio = radios_[number];
  switch (radio.phase) {
    case Phase::backing_off:
    case Phase::first_cca:
    case Phase::second_cca:
      return is_member(number) ? assess_in_slots(number, at) : assess(number, at);
    case Phase::turning:
      return send(number, at);
    case Phase::awaiting_ack:
      if (++radio.tries > settings_.retries) return give_up(number, DeliveryOutcome::no_ack, at);
      return compete(number, at);
    default:
      return;
  }
}

// Header octets of a radio's frames for its first message.
std::size_t Medium::head(std::size_t sender) const {
  const std::size_t to = post_.first(sender).to;
  const std::size_t more = to == everyone || are_in_one_pan(sender, to) ? 0 : sender_pan;
  return (settings_.extended ? extended_header : header) + more;
}

std::size_t Medium::size_of_frame(std::size_t sender) const {
  const medium::Message& message = post_.first(sender);
  return frame_size(message.size, message.frame, head(sender));
}

bool Medium::is_last_frame(std::size_t sender) const {
  const medium::Message& message = post_.first(sender);
  return message.frame + 1 >= frames_of(message.size, head(sender));
}

void Medium::send(std::size_t number, Time at) {
  const Time length = air_time(size_of_frame(number));
  wait(number, Phase::sending, never);
  const Frame& frame = air_.begin(number, at, length, data_frame, nothing, post_.first(number).to, cca_window);
  agenda_.put(frame.end, frame_ends, frame.id);
}

void Medium::send_ack(std::size_t number, Time at) {
  const Radio& radio = radios_[number];
  wait_with_ack(number, Phase::sending, never);
  const Frame& frame = air_.begin(number, at, air_time(ack_frame), data_frame, radio.ack_of, radio.ack_to, cca_window);
  agenda_.put(frame.end, frame_ends, frame.id);
}

// ---- Frames -------------------------------------------------------------------------------------------------------

void Medium::end_frame(std::uint64_t id, Time at) {
  const Frame frame = air_.frame(id);
  const std::vector<Heard>& heard = air_.end(frame);
  if (frame.format == beacon) return end_beacon(frame, heard, at);
  if (frame.ack_of != nothing) return end_ack(frame, heard, at);
  Radio& sender = radios_[frame.sender];
  if (sender.phase != Phase::sending) return;  // it has left since
  air_.deafen(frame.sender, at + turnaround);
  sender.sent = id;
  sender.spaced = at + (frame.end - frame.begin > air_time(18) ? long_spacing : short_spacing);
  if (frame.to == everyone)
    end_broadcast(frame.sender, filtered(frame.sender, heard), at);
  else
    end_unicast(frame, heard[frame.to], at);
}

void Medium::end_ack(const Frame& frame, const std::vector<Heard>& heard, Time at) {
  if (radios_[frame.sender].ack_phase == Phase::sending) {
    wait_with_ack(frame.sender, Phase::idle, never);
    air_.deafen(frame.sender, at + turnaround);
  }
  const Radio& waits = radios_[frame.to];
  const bool is_its_own = waits.phase == Phase::awaiting_ack && waits.sent == frame.ack_of;
  if (!is_its_own || heard[frame.to] != Heard::whole) return;
  if (is_member(frame.to)) radios_[frame.to].spaced = at + spacing_after(size_of_frame(frame.to));
  go_on_with_message(frame.to, at);
}

// Receivers in another PAN receive the frame and discard it (7.5.6.2, third level); so do devices from another device.
const std::vector<Heard>& Medium::filtered(std::size_t sender, const std::vector<Heard>& heard) {
  if (settings_.pans.empty() && members_.empty()) return heard;
  filtered_ = heard;
  for (std::size_t i = 0; i < heard.size(); ++i)
    if (heard[i] != Heard::gone && (!are_in_one_pan(sender, i) || (is_device(sender) && is_device(i))))
      filtered_[i] = Heard::no_link;
  return filtered_;
}

void Medium::end_broadcast(std::size_t sender, const std::vector<Heard>& heard, Time at) {
  if (is_last_frame(sender))
    post_.last_frame_heard(sender, heard, air_, at);
  else
    post_.frame_heard(sender, heard);
  go_on_with_message(sender, at);
}

void Medium::end_unicast(const Frame& frame, Heard heard, Time at) {
  Radio& sender = radios_[frame.sender];
  if (heard != Heard::whole) {
    sender.last_loss = medium::fate_of(heard);
    if (!settings_.acknowledged) post_.settle(frame.sender, sender.last_loss);
  } else {
    if (is_last_frame(frame.sender)) post_.deliver(frame.sender, frame.to, air_, at);
    sender.arrived = true;
  }
  if (!settings_.acknowledged) return go_on_with_message(frame.sender, at);
  wait(frame.sender, Phase::awaiting_ack, at + ack_wait);
  if (heard == Heard::whole && radios_[frame.to].ack_phase == Phase::idle) owe_ack(frame, at);
}

void Medium::owe_ack(const Frame& frame, Time at) {
  const Time begin = is_member(frame.to) ? ack_time(frame.to, at) : at + turnaround;
  if (begin == never) return;
  radios_[frame.to].ack_of = frame.id;
  radios_[frame.to].ack_to = frame.sender;
  air_.deafen(frame.to, never);
  wait_with_ack(frame.to, Phase::turning, begin);
}

// ---- Messages -----------------------------------------------------------------------------------------------------

void Medium::go_on_with_message(std::size_t sender, Time at) {
  if (is_last_frame(sender)) return end_message(sender, at);
  ++post_.first(sender).frame;
  radios_[sender].tries = 0;
  radios_[sender].arrived = false;
  compete(sender, at);
}

// Drops the message, for lack of acknowledgements, though the frame may have arrived, or of a free channel.
void Medium::give_up(std::size_t sender, DeliveryOutcome why, Time at) {
  const Radio& radio = radios_[sender];
  if (why == DeliveryOutcome::no_ack && !radio.arrived) why = radio.last_loss;
  post_.settle(sender, why);
  end_message(sender, at);
}

void Medium::end_message(std::size_t sender, Time at) {
  post_.drop_first(sender);
  begin_message(sender, at);
}

// ---- State --------------------------------------------------------------------------------------------------------

namespace {

// Lists a record's members, for both directions.
constexpr auto fields = [](auto&& field, auto& r) {
  field(r.phase), field(r.due), field(r.spaced), field(r.backoffs), field(r.exponent), field(r.tries), field(r.sent);
  field(r.arrived), field(r.last_loss), field(r.ack_phase), field(r.ack_due), field(r.ack_of), field(r.ack_to);
  field(r.draws);
};

}  // namespace

std::string Medium::save() const {
  medium::Writer out;
  medium::save(out, air_, post_, radios_, fields);
  for (const Member& m : members_) out.put(m.is_one), out.put(m.is_in_step), out.put(m.beacons_lost);
  return out.take();
}

void Medium::load(std::string_view bytes) {
  *this = Medium(random_);
  if (bytes.empty()) return;
  medium::Reader in(bytes);
  medium::load(in, air_, post_, radios_, fields);
  if (in.is_at_end()) return;  // without beacons
  members_.resize(radios_.size());
  for (Member& m : members_) in.get(m.is_one), in.get(m.is_in_step), in.get(m.beacons_lost);
}

}  // namespace muster::lrwpan
