// Frames in the air, and what each radio makes of them. A frame has two events, its begin and its end, and a receiver
// none: at both all receivers are looked at in one go, and what they heard since is judged by its ratio to noise and to
// all else that was in the air.
#pragma once

#include <vector>

#include "medium/bit_law.hpp"
#include "medium/bytes.hpp"
#include "medium/channel.hpp"
#include "muster/random.hpp"

namespace muster::medium {

constexpr std::uint64_t nothing = 0;  // no frame

// How a frame's bits come: a head sent in one way, a body in another, a tail without any.
struct Format {
  const BitLaw* head_law = nullptr;
  Time head_from = 0, head_until = 0;  // since the frame's begin
  double head_bits = 0;                // a ns
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
  std::size_t to = 0;              // whom the medium access means it for
};

// How a receiver finds frames. Ratios are of one frame to noise and to all others together.
struct Hearing {
  double noise = 0;          // mW
  double found_above = 0;    // ratio
  Time capture_within = 0;   // so long after a frame's begin another one may still take its receiver over,
  double capture_above = 0;  // above this ratio
  Band band;                 // what it lets in of jammers
};

// What became of a frame at a receiver.
enum class Heard : std::uint8_t { whole = 1, too_weak, no_link, collided, gone };

class Air {
 public:
  Air(const Stream& random, std::vector<Format> formats) : random_(random), formats_(std::move(formats)) {}

  // Before anything else in a run: what is in the air goes on under this channel.
  void enter(const Channel& channel, const Hearing& hearing);

  // What was heard since frames last began or ended, or a jammer went on or off. Both begin() and end() call it.
  void hear(Time until) { shares_.empty() ? hear_piece(until) : hear_between_switches(until); }

  // From now on all receive in this band.
  void tune(Time at, const Band& band);

  // Until then a radio finds no frame, and what it listens to is lost.
  void deafen(std::size_t radio, Time until);
  bool is_deaf(std::size_t radio, Time at) const { return deaf_until_[radio] > at; }
  void forget(std::size_t radio);

  // Frames that ended more than `remembered` before it are forgotten.
  const Frame& begin(std::size_t sender, Time at, Time length, std::size_t format, std::uint64_t ack_of, std::size_t to,
                     Time remembered);
  // Of each radio, what became of the frame there.
  const std::vector<Heard>& end(const Frame& frame);
  // Who listens to the frame though it stands no more than `ratio` above noise and others by now gives it up.
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
  Time next_switch(Time after) const;  // when one of them goes on or off

  // Of the frame that a radio heard last: rssi as its preamble was found [dBm]; mean ratio.
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

  // Of each radio. What it listens to, ln of the probability that all bits came right so far, what others sent
  // meanwhile [mW ns], and its rssi.
  std::vector<std::uint64_t> lock_;
  std::vector<double> log_right_, others_, rssi_;
  std::vector<Time> deaf_until_;

  // The same again, as follows from the channel.
  std::vector<double> shares_;  // of each jammer's power that lies in the band
  std::vector<double> total_, signal_, ratio_;
  std::vector<Heard> heard_;
};

}  // namespace muster::medium
