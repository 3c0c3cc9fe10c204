// Superframes, and the slotted CSMA/CA of their contention access period (IEEE 802.15.4-2006, 7.5.1.1 and 7.5.1.4).
#include "medium.hpp"

namespace muster::lrwpan {
namespace {

using medium::Frame;
using medium::never;
using medium::nothing;

enum Part { beacon_is_due, cap_begins, cap_ends };  // of a superframe

}  // namespace

// ---- Superframes --------------------------------------------------------------------------------------------------

// A radio that has come into the PAN or gone out of it contends anew, by the rules that hold there.
void Medium::enter_members(Time since) {
  if (!superframe_.exists() && members_.empty()) return;
  members_.resize(radios_.size());
  std::vector<std::size_t> changed;
  for (std::size_t i = 0; i < members_.size(); ++i) {
    Member& member = members_[i];
    member.heard = member.lost = member.silent = member.between_devices = 0;
    const bool is_one = superframe_.exists() && channel_->alive[i] && are_in_one_pan(i, settings_.coordinator);
    if (is_one != member.is_one) {
      member = {};
      changed.push_back(i);
    }
    member.is_one = is_one;
    if (is_one && i == settings_.coordinator) member.is_in_step = true;
  }
  if (!superframe_.exists()) members_.clear();
  for (const std::size_t i : changed) {
    const Phase phase = radios_[i].phase;
    if (phase == Phase::backing_off || phase == Phase::first_cca || phase == Phase::second_cca) begin_message(i, since);
  }
}

void Medium::put_superframes(Time since, Time until) {
  for (Time begin = superframe_.begin(since); begin < until; begin += superframe_.interval) {
    if (begin >= since) agenda_.put(begin, superframe_goes_on, beacon_is_due);
    if (begin + superframe_.cap >= since) agenda_.put(begin + superframe_.cap, superframe_goes_on, cap_begins);
    const bool is_inactive_then = superframe_.active < superframe_.interval;
    if (is_inactive_then && begin + superframe_.active >= since)
      agenda_.put(begin + superframe_.active, superframe_goes_on, cap_ends);
  }
}

void Medium::handle_superframe(std::uint64_t part, Time at) {
  if (part == beacon_is_due) return send_beacon(at);
  if (part == cap_begins) return begin_cap(at);
  end_cap(at);
}

// Without any assessment. A coordinator that is still in the midst of a frame, since superframes have changed, leaves
// the beacon out.
void Medium::send_beacon(Time at) {
  for (std::size_t i = 0; i < members_.size(); ++i)
    if (is_device(i) && members_[i].beacons_lost < most_lost_beacons) ++members_[i].beacons_lost;
  const std::size_t coordinator = settings_.coordinator;
  if (!is_member(coordinator)) return;
  const Radio& radio = radios_[coordinator];
  const bool is_sending = radio.phase == Phase::turning || radio.phase == Phase::sending;
  if (is_sending || radio.ack_phase != Phase::idle) return;
  air_.deafen(coordinator, never);
  const Time length = air_time(beacon_frame(settings_.extended));
  const Frame& frame = air_.begin(coordinator, at, length, beacon, nothing, everyone, cca_window);
  agenda_.put(frame.end, frame_ends, frame.id);
}

void Medium::end_beacon(const Frame& frame, const std::vector<Heard>& heard, Time at) {
  if (!channel_->alive[frame.sender]) return;
  air_.deafen(frame.sender, at + turnaround);
  radios_[frame.sender].spaced = at + spacing_after(beacon_frame(settings_.extended));
  for (std::size_t i = 0; i < members_.size(); ++i) {
    if (!is_device(i) || heard[i] != Heard::whole) continue;
    members_[i].is_in_step = true;
    members_[i].beacons_lost = 0;
    ++members_[i].heard;
  }
}

// Devices that have lost too many beacons in a row (7.5.4.1) drop what they have to send.
void Medium::begin_cap(Time at) {
  for (std::size_t i = 0; i < members_.size(); ++i) {
    Member& member = members_[i];
    if (!is_device(i) || member.beacons_lost == 0) continue;
    ++member.lost;
    if (!member.is_in_step || member.beacons_lost < most_lost_beacons) continue;
    member.is_in_step = false;
    const Phase phase = radios_[i].phase;
    if (phase != Phase::turning && phase != Phase::sending) begin_message(i, at);
  }
}

// Who knows when the next beacon is due switches its receiver off until then.
void Medium::end_cap(Time at) {
  for (std::size_t i = 0; i < members_.size(); ++i) {
    const Radio& radio = radios_[i];
    const bool is_sending = radio.phase == Phase::turning || radio.phase == Phase::sending;
    if (is_member(i) && members_[i].is_in_step && !is_sending && radio.ack_phase == Phase::idle)
      air_.deafen(i, superframe_.begin(at) + superframe_.interval);
  }
}

// ---- Access -------------------------------------------------------------------------------------------------------

// Outcome of the sender's first message where it may not be sent; otherwise under_way.
DeliveryOutcome Medium::refusal(std::size_t sender) {
  if (!is_device(sender)) return DeliveryOutcome::under_way;
  const medium::Message& message = post_.first(sender);
  const std::size_t to = message.to, copies = message.receivers.count();
  if (to != everyone && is_device(to)) {
    members_[sender].between_devices += copies;
    return DeliveryOutcome::no_link;
  }
  if (members_[sender].is_in_step) return DeliveryOutcome::under_way;
  members_[sender].silent += copies;
  return DeliveryOutcome::no_access;
}

// The count of periods stands still outside of the CAP, and goes on in the next one.
void Medium::back_off_in_slots(std::size_t number, Time from) {
  Time periods = backoff_periods(number);
  Time at = superframe_.boundary_in_cap(from);
  for (Time left; periods > (left = superframe_.left(at) / unit_backoff); periods -= left)
    at = superframe_.begin(at) + superframe_.interval + superframe_.cap;
  wait(number, Phase::backing_off, at + periods * unit_backoff);
}

// Two assessments at the begin of two back-off periods, and the frame at that of a third. Where they and all that
// follows find no room, the radio draws anew in the next superframe.
void Medium::assess_in_slots(std::size_t number, Time at) {
  const Phase phase = radios_[number].phase;
  if (phase == Phase::backing_off) {
    if (fits_in_cap(number, at)) return wait(number, Phase::first_cca, at + cca_window);
    return back_off(number, superframe_.begin(at) + (at < superframe_.cap_begin(at) ? 0 : superframe_.interval));
  }
  if (!is_free(number, at)) return back_off_again(number, at);
  if (phase == Phase::first_cca) return wait(number, Phase::second_cca, at + unit_backoff);
  turn_round(number, at);
}

// A transaction, its acknowledgement included, ends one spacing before the CAP does (7.5.1.1.1).
bool Medium::fits_in_cap(std::size_t sender, Time at) const {
  const std::size_t size = size_of_frame(sender);
  Time end = at + contention_window * unit_backoff + air_time(size);
  if (settings_.acknowledged && post_.first(sender).to != everyone)
    end = Superframe::boundary(end + turnaround) + air_time(ack_frame);
  return end + spacing_after(size) - at <= superframe_.left(at);
}

// An acknowledgement begins on a boundary, too (7.5.6.4.2). A receiver that is out of step knows none.
Time Medium::ack_time(std::size_t receiver, Time at) const {
  const Time begin = Superframe::boundary(at + turnaround);
  return members_[receiver].is_in_step && air_time(ack_frame) <= superframe_.left(begin) ? begin : never;
}

}  // namespace muster::lrwpan
