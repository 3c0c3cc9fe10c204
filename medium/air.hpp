// Frames in the air, and their reception by each radio. A frame has two events, its begin and its end, and a receiver
// none. Each event updates all receivers at once: the interval since the last event is evaluated by the ratio of signal
// to noise and interference.
#pragma once

#include <vector>

#include "medium/bit_law.hpp"
#include "medium/bytes.hpp"
#include "medium/channel.hpp"
#include "muster/random.hpp"

namespace muster::medium {

constexpr std::uint64_t nothing = 0;  // no frame

// Bit layout of a frame: a head in one modulation, a body in another, a tail without bits.
struct Format {
  const BitLaw* head_law = nullptr;
  Time head_from = 0, head_until = 0;  // since the frame's begin
  double head_bits = 0;                // per ns
  const BitLaw* body_law = nullptr;
  double body_bits = 0;
  Time tail = 0;
};

struct Frame {
  std::uint64_t id = nothing;
  std::size_t sender = 0;
  Time begin = 0, end = 0;
  std::size_t format = 0;
  std::uint64_t ack_of = nothing;  // the frame that it acknowledges
  std::size_t to = 0;              // the intended receiver of the medium access
};

// Parameters of reception. Ratios are of one frame to noise plus all other power.
struct Hearing {
  double noise = 0;          // mW
  double found_above = 0;    // ratio
  Time capture_within = 0;   // a later frame may capture the receiver until so long after a frame's begin,
  double capture_above = 0;  // if its ratio is above this
  Band band;                 // filter for jammers' power
};

// Outcomes of a frame at a receiver.
enum class Heard : std::uint8_t { whole = 1, too_weak, no_link, collided, gone };

class Air {
 public:
  Air(const Stream& random, std::vector<Format> formats) : random_(random), formats_(std::move(formats)) {}

  // Call first in a run: frames already in the air continue under this channel.
  void enter(const Channel& channel, const Hearing& hearing);

  // Evaluates the interval since frames last began or ended, or a jammer switched. begin() and end() call it.
  void hear(Time until) { shares_.empty() ? hear_piece(until) : hear_between_switches(until); }

  // Sets the band in which all radios receive from now on.
  void tune(Time at, const Band& band);

  // Until then the radio detects no frame, and its present frame is lost.
  void deafen(std::size_t radio, Time until);
  bool is_deaf(std::size_t radio, Time at) const { return deaf_until_[radio] > at; }
  void forget(std::size_t radio);

  // Drops frames that ended more than `remembered` ago.
  const Frame& begin(std::size_t sender, Time at, Time length, std::size_t format, std::uint64_t ack_of, std::size_t to,
                     Time remembered);
  // Outcome of the frame at each radio.
  const std::vector<Heard>& end(const Frame& frame);
  // Receivers of the frame abandon it if its ratio to noise and others is by now at most `ratio`.
  void drop_weak(std::uint64_t id, Time at, double ratio);

  const Frame& frame(std::uint64_t id) const { return frames_[id - frames_.front().id]; }
  const std::vector<Frame>& frames() const { return frames_; }  // in the air, or not yet forgotten
  std::uint64_t listens_to(std::size_t radio) const { return lock_[radio]; }
  double power(std::size_t radio) const { return total_[radio]; }  // of all frames in the air and of jammers, mW
  double power_at(std::size_t radio, Time at) const;               // the same, at a time that is remembered

  // Mean power of jammers, mW.
  double jammed(std::size_t radio, Time from, Time until) const {
    return shares_.empty() ? 0 : sum_of_jammers(radio, from, until);
  }
  Time next_switch(Time after) const;  // the next time at which one of them switches

  // Of the last frame that a radio received: rssi at its preamble [dBm]; mean ratio.
  double rssi(std::size_t radio) const { return rssi_[radio]; }
  double ratio(std::size_t radio) const { return ratio_[radio]; }

  void save(Writer& out) const;
  void load(Reader& in);

 private:
  void hear_piece(Time until);
  void hear_between_switches(Time until);
  double sum_of_jammers(std::size_t radio, Time from, Time until) const;
  bool is_whole(std::size_t radio, std::uint64_t frame) const;
  void sum_up(Time at);
  void share_out();
  Stream random_;
  std::vector<Format> formats_;
  const Channel* channel_ = nullptr;
  Hearing hearing_;

  std::vector<Frame> frames_;  // by begin; their numbers follow one another
  std::uint64_t begun_ = nothing;
  Time heard_until_ = 0;

  // Of each radio: its present frame, ln of the probability that all bits so far are right, energy of others meanwhile
  // [mW ns], and its rssi.
  std::vector<std::uint64_t> lock_;
  std::vector<double> log_right_, others_, rssi_;
  std::vector<Time> deaf_until_;

  // Derived from the channel at the begin of a run.
  std::vector<double> shares_;  // fraction of each jammer's power within the band
  std::vector<double> total_, signal_, ratio_;
  std::vector<Heard> heard_;
};

}  // namespace muster::medium
