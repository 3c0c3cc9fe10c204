#include "medium/air.hpp"

#include <algorithm>

namespace muster::medium {
namespace {

Time overlap(Time from, Time until, Time since, Time to) {
  return std::max<Time>(0, std::min(until, to) - std::max(from, since));
}

// Bits of a frame within an interval.
struct Bits {
  double head, body;
};
Bits bits_of(const Frame& frame, const Format& format, Time from, Time until) {
  const Time head_end = frame.begin + format.head_until;
  const Time head = overlap(from, until, frame.begin + format.head_from, head_end);
  const Time body = overlap(from, until, head_end, frame.end - format.tail);
  return {static_cast<double>(head) * format.head_bits, static_cast<double>(body) * format.body_bits};
}

}  // namespace

void Air::enter(const Channel& channel, const Hearing& hearing) {
  channel_ = &channel;
  hearing_ = hearing;
  share_out();
  const std::size_t n = channel.radios;
  lock_.resize(n, nothing);
  log_right_.resize(n), others_.resize(n), rssi_.resize(n), deaf_until_.resize(n);
  total_.resize(n), signal_.assign(n, 0), ratio_.resize(n), heard_.resize(n);
  for (std::size_t i = 0; i < n; ++i)
    if (lock_[i] != nothing) signal_[i] = channel.power_from(frame(lock_[i]).sender)[i];
  sum_up(heard_until_);
}

void Air::share_out() {
  shares_.clear();
  for (const Jammer& jammer : channel_->jammers) shares_.push_back(share_of(jammer.band, hearing_.band));
}

void Air::tune(Time at, const Band& band) {
  hear(at);
  hearing_.band = band;
  share_out();
  sum_up(at);
}

void Air::deafen(std::size_t radio, Time until) {
  lock_[radio] = nothing;
  deaf_until_[radio] = until;
}

void Air::forget(std::size_t radio) { deafen(radio, 0); }

// Sums in the order of the frames' begins, so the sum does not depend on which other frames have ended since.
void Air::sum_up(Time at) {
  const std::size_t n = total_.size();
  for (std::size_t i = 0; i < n; ++i) total_[i] = jammed(i, at, at + 1);
  for (const Frame& frame : frames_) {
    if (frame.end <= at) continue;
    const double* power = channel_->power_from(frame.sender);
    for (std::size_t i = 0; i < n; ++i) total_[i] += power[i];
  }
}

double Air::power_at(std::size_t radio, Time at) const {
  double sum = jammed(radio, at, at + 1);
  for (const Frame& frame : frames_)
    if (frame.begin <= at && at < frame.end) sum += channel_->power_from(frame.sender)[radio];
  return sum;
}

double Air::sum_of_jammers(std::size_t radio, Time from, Time until) const {
  double sum = 0;
  for (std::size_t i = 0; i < shares_.size(); ++i) {
    const Jammer& jammer = channel_->jammers[i];
    const Time on = jammer.pulses.on_between(from, until);
    if (shares_[i] > 0 && on > 0)  // its power at its own radio is infinite
      sum += shares_[i] * jammer.power[radio] * (static_cast<double>(on) / static_cast<double>(until - from));
  }
  return sum;
}

Time Air::next_switch(Time after) const {
  Time next = never;
  for (std::size_t i = 0; i < shares_.size(); ++i)
    if (shares_[i] > 0) next = std::min(next, channel_->jammers[i].pulses.next_switch(after));
  return next;
}

const Frame& Air::begin(std::size_t sender, Time at, Time length, std::size_t format, std::uint64_t ack_of,
                        std::size_t to, Time remembered) {
  hear(at);
  const auto kept =
      std::find_if(frames_.begin(), frames_.end(), [&](const Frame& f) { return f.end >= at - remembered; });
  frames_.erase(frames_.begin(), kept);
  Frame& latest = frames_.emplace_back();
  latest.id = ++begun_, latest.sender = sender, latest.begin = at, latest.end = at + length;
  latest.format = format, latest.ack_of = ack_of, latest.to = to;
  const bool captures = hearing_.capture_within > 0;
  const double* power = channel_->power_from(sender);
  const double* rssi = channel_->rssi_from(sender);
  for (std::size_t i = 0; i < total_.size(); ++i) {
    const double others = total_[i] + hearing_.noise;
    total_[i] += power[i];
    const bool is_free = lock_[i] == nothing;
    if (!is_free && (!captures || at - frame(lock_[i]).begin >= hearing_.capture_within)) continue;
    if (power[i] <= (is_free ? hearing_.found_above : hearing_.capture_above) * others) continue;
    if (i == sender || is_deaf(i, at) || std::isnan(rssi[i])) continue;
    lock_[i] = begun_;
    signal_[i] = power[i];
    rssi_[i] = rssi[i];
    log_right_[i] = others_[i] = 0;
  }
  return frames_.back();
}

void Air::hear_between_switches(Time until) {
  const bool is_heard = std::any_of(lock_.begin(), lock_.end(), [](std::uint64_t id) { return id != nothing; });
  for (Time at = heard_until_; is_heard && (at = next_switch(at)) <= until;) {
    hear_piece(at);
    sum_up(at);
  }
  hear_piece(until);
  sum_up(until);
}

// An interval with the same frames and jammers throughout.
void Air::hear_piece(Time until) {
  const Time from = heard_until_;
  heard_until_ = until;
  if (from == until || frames_.empty()) return;
  const auto lasted = static_cast<double>(until - from);
  std::uint64_t id = nothing;
  Bits bits{};
  const Format* format = nullptr;
  double clean = 0;
  for (std::size_t i = 0; i < lock_.size(); ++i) {
    if (lock_[i] == nothing) continue;
    if (!format || lock_[i] != id) {
      id = lock_[i];
      format = &formats_[frame(id).format];
      bits = bits_of(frame(id), *format, from, until);
      clean = std::max(format->body_law->clean(), bits.head > 0 ? format->head_law->clean() : 0);
    }
    const double others = total_[i] - signal_[i];
    others_[i] += others * lasted;
    if (signal_[i] >= clean * (others + hearing_.noise)) continue;
    const double ratio = signal_[i] / (others + hearing_.noise);
    if (bits.head > 0) log_right_[i] += bits.head * format->head_law->log_right(ratio);
    if (bits.body > 0) log_right_[i] += bits.body * format->body_law->log_right(ratio);
  }
}

// Draws a random number only where the outcome is uncertain.
bool Air::is_whole(std::size_t radio, std::uint64_t frame) const {
  const double log_right = log_right_[radio];
  if (log_right > -1e-12 || log_right < -40) return log_right > -1;
  return random_.of(channel_->keys[radio]).uniform(frame) < std::exp(log_right);
}

const std::vector<Heard>& Air::end(const Frame& frame) {
  hear(frame.end);
  const double* power = channel_->power_from(frame.sender);
  const double* rssi = channel_->rssi_from(frame.sender);
  const auto lasted = static_cast<double>(frame.end - frame.begin);
  for (std::size_t i = 0; i < lock_.size(); ++i) {
    if (lock_[i] == frame.id) {
      lock_[i] = nothing;
      ratio_[i] = signal_[i] / (others_[i] / lasted + hearing_.noise);
      heard_[i] = is_whole(i, frame.id) ? Heard::whole : others_[i] > 0 ? Heard::collided : Heard::too_weak;
    } else if (!channel_->alive[i]) {
      heard_[i] = Heard::gone;
    } else if (power[i] == 0) {
      heard_[i] = Heard::no_link;
    } else {
      const bool strong = !std::isnan(rssi[i]) && power[i] > hearing_.found_above * hearing_.noise;
      heard_[i] = strong ? Heard::collided : Heard::too_weak;
    }
  }
  sum_up(frame.end);
  return heard_;
}

void Air::drop_weak(std::uint64_t id, Time at, double ratio) {
  hear(at);
  for (std::size_t i = 0; i < lock_.size(); ++i)
    if (lock_[i] == id && signal_[i] <= ratio * (total_[i] - signal_[i] + hearing_.noise)) lock_[i] = nothing;
}

void Air::save(Writer& out) const {
  out.put(begun_);
  out.put(heard_until_);
  out.put(frames_.size());
  for (const Frame& f : frames_)
    out.put(f.id), out.put(f.sender), out.put(f.begin), out.put(f.end), out.put(f.format), out.put(f.ack_of),
        out.put(f.to);
  out.put_all(lock_), out.put_all(log_right_), out.put_all(others_), out.put_all(rssi_), out.put_all(deaf_until_);
}

void Air::load(Reader& in) {
  in.get(begun_);
  in.get(heard_until_);
  frames_.resize(in.count());
  for (Frame& f : frames_)
    in.get(f.id), in.get(f.sender), in.get(f.begin), in.get(f.end), in.get(f.format), in.get(f.ack_of), in.get(f.to);
  in.get_all(lock_), in.get_all(log_right_), in.get_all(others_), in.get_all(rssi_), in.get_all(deaf_until_);
}

}  // namespace muster::medium
