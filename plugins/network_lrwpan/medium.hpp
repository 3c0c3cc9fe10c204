// Radios that share one channel by CSMA/CA (IEEE 802.15.4-2006, 7.5.1.4), with collisions and acknowledgements:
// unslotted, or in the superframes of one PAN's coordinator. A discrete-event simulation with events per transmission,
// not per receiver.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "medium/air.hpp"
#include "medium/event_queue.hpp"
#include "medium/transmit_queue.hpp"
#include "superframe.hpp"

namespace muster::lrwpan {

using medium::Channel;
using medium::DeliveryOutcome;
using medium::Heard;
using medium::Report;

// Modes of clear channel assessment. All compare the power of others with a threshold. `standard`: its mean over the 8
// symbols. `ns3`, as in ns-3 3.37: at their end and whenever a frame begins among them. A frame that ends among them is
// missed, while a radio that receives a frame, however weak, finds the channel busy. `instant`: at their end alone.
enum class Cca { standard = 1, ns3, instant };

struct Settings {
  double noise = 0;  // mW
  double busy = 0;   // power above which the channel is busy, mW
  int channel = 11;
  Cca cca = Cca::standard;
  std::size_t queue = 16;    // limit of messages in a radio's queue
  bool acknowledged = true;  // frames to one receiver
  int retries = 3;           // macMaxFrameRetries
  bool extended = false;     // addresses of 64 bits, not 16
  double capture = 0;        // ratio above which a later frame captures a receiver; 0: never

  std::vector<std::uint16_t> pans;  // of each radio; empty: all are in one

  int beacon_order = no_beacons, superframe_order = no_beacons;  // of the coordinator's PAN
  std::size_t coordinator = 0;
};

// A radio of the PAN that has beacons.
struct Member {
  bool is_one = false;
  bool is_in_step = false;        // it knows when superframes begin; else it is silent
  std::uint8_t beacons_lost = 0;  // in a row, up to most_lost_beacons
  // In this run.
  std::uint64_t heard = 0, lost = 0;  // beacons
  std::uint64_t silent = 0;           // copies not sent for want of beacons
  std::uint64_t between_devices = 0;  // copies from a device to another, for which a star has no link
};

class Medium {
 public:
  explicit Medium(const Stream& random);

  // All state that outlives a call of run(): the same bytes make the same future.
  std::string save() const;
  void load(std::string_view bytes);

  // A message that `from` wants to send at `at`, a time of the next run(). `to`: a radio, or `everyone`.
  static constexpr std::size_t everyone = medium::everyone;
  void ask(Time at, std::size_t from, std::size_t to, std::string payload) {
    post_.ask(at, from, to, std::move(payload));
  }

  // Runs from `since` to `until`. The report is valid until the next run.
  const Report& run(Time since, Time until, const Channel& channel, const Settings& settings);

  const std::vector<Member>& members() const { return members_; }             // of each radio; empty without beacons
  const std::vector<medium::Frame>& frames() const { return air_.frames(); }  // in the air, or ended lately

 private:
  enum class Phase : std::uint8_t { idle, backing_off, turning, sending, awaiting_ack, first_cca, second_cca };

  // State of a radio's first message, and of an acknowledgement that it owes.
  struct Radio {
    Phase phase = Phase::idle;
    Time due = medium::never;  // when the phase ends by itself
    Time spaced = 0;           // earliest time of its next frame
    int backoffs = 0, exponent = 0, tries = 0;
    std::uint64_t sent = medium::nothing;                   // its last frame
    bool arrived = false;                                   // the frame, at its one receiver
    DeliveryOutcome last_loss = DeliveryOutcome::too_weak;  // of the frame, there

    Phase ack_phase = Phase::idle;
    Time ack_due = medium::never;
    std::uint64_t ack_of = medium::nothing;
    std::size_t ack_to = everyone;

    std::uint64_t draws = 0;  // number of random numbers drawn
  };

  // Order of simultaneous events: frames end, requests come, phases end, acknowledgements are sent; then superframes.
  enum Kind { frame_ends, request_comes, phase_ends, ack_is_due, superframe_goes_on };
  enum Format : std::size_t { data_frame, beacon };  // of frames: their bits are alike

  bool are_in_one_pan(std::size_t a, std::size_t b) const {
    return settings_.pans.empty() || settings_.pans[a] == settings_.pans[b];
  }
  std::size_t head(std::size_t sender) const;
  std::size_t size_of_frame(std::size_t sender) const;
  bool is_last_frame(std::size_t sender) const;
  void wait(std::size_t radio, Phase phase, Time until);
  void wait_with_ack(std::size_t radio, Phase phase, Time until);
  void handle(const medium::Event& event);

  void begin_message(std::size_t sender, Time at);
  void compete(std::size_t radio, Time at);
  Time backoff_periods(std::size_t radio);
  void back_off(std::size_t radio, Time from);
  void assess(std::size_t radio, Time at);
  void turn_round(std::size_t radio, Time at);
  void back_off_again(std::size_t radio, Time at);
  bool is_free(std::size_t radio, Time at) const;
  bool is_busy(std::size_t radio, Time at) const;
  void end_phase(std::size_t radio, Time at);
  void send(std::size_t radio, Time at);
  void owe_ack(const medium::Frame& frame, Time at);
  void send_ack(std::size_t radio, Time at);

  // Superframes, in slots.cpp.
  bool is_member(std::size_t radio) const { return !members_.empty() && members_[radio].is_one; }
  bool is_device(std::size_t radio) const { return is_member(radio) && radio != settings_.coordinator; }
  void enter_members(Time since);
  void put_superframes(Time since, Time until);
  void handle_superframe(std::uint64_t part, Time at);
  void send_beacon(Time at);
  void end_beacon(const medium::Frame& frame, const std::vector<Heard>& heard, Time at);
  void begin_cap(Time at);
  void end_cap(Time at);
  DeliveryOutcome refusal(std::size_t sender);
  void back_off_in_slots(std::size_t radio, Time from);
  void assess_in_slots(std::size_t radio, Time at);
  bool fits_in_cap(std::size_t sender, Time at) const;
  Time ack_time(std::size_t receiver, Time at) const;

  void end_frame(std::uint64_t id, Time at);
  void end_ack(const medium::Frame& frame, const std::vector<Heard>& heard, Time at);
  const std::vector<Heard>& filtered(std::size_t sender, const std::vector<Heard>& heard);
  void end_broadcast(std::size_t sender, const std::vector<Heard>& heard, Time at);
  void end_unicast(const medium::Frame& frame, Heard heard, Time at);

  void go_on_with_message(std::size_t sender, Time at);
  void give_up(std::size_t sender, DeliveryOutcome why, Time at);
  void end_message(std::size_t sender, Time at);

  Settings settings_;
  Stream random_;
  medium::Air air_;
  medium::TransmitQueue post_;
  medium::EventQueue agenda_;
  std::vector<Radio> radios_;
  std::vector<Member> members_;
  Superframe superframe_;
  const Channel* channel_ = nullptr;  // of the run
  std::vector<Heard> filtered_;       // buffer, kept from frame to frame
};

}  // namespace muster::lrwpan
