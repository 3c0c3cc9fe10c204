// Stations that share one channel by the distributed coordination function (IEEE 802.11-2016, 10.3), with backoff,
// collisions and acknowledgements. A discrete-event simulation with events per transmission, not per receiver or slot.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "medium/air.hpp"
#include "medium/event_queue.hpp"
#include "medium/transmit_queue.hpp"
#include "standard.hpp"

namespace muster::wifi {

using medium::Channel;
using medium::DeliveryOutcome;
using medium::Heard;
using medium::Report;

struct Settings {
  double noise = 0;  // mW
  double busy = 0;   // power above which the channel is busy, from any source, mW
  std::size_t rate = 0;
  int channel = 1;
  Time slot = long_slot;
  std::size_t queue = 64;    // limit of messages in a station's queue
  bool acknowledged = true;  // frames to one receiver
  int retries = 6;           // of a frame; dot11ShortRetryLimit counts the first try, too
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

 private:
  enum class Phase : std::uint8_t { idle, contending, sending, awaiting_ack };

  struct Station {
    Phase phase = Phase::idle;
    bool sends_ack = false;
    bool is_busy = false;      // its channel state
    bool heard_wrong = false;  // the last frame that it received was faulty
    int slots = 0;             // left to count down, at counts_from
    int window = least_window;
    int tries = 0;
    Time counts_from = 0;          // while the channel is idle: since when slots count
    Time due = medium::never;      // time of its transmission
    Time timeout = medium::never;  // end of its wait for an acknowledgement
    Time reserved = 0;             // NAV: silence until then, set by frames of others
    std::uint64_t sent = medium::nothing;
    bool arrived = false;                                   // the frame, at its one receiver
    DeliveryOutcome last_loss = DeliveryOutcome::too_weak;  // of the frame, there
    Time ack_due = medium::never;
    std::uint64_t ack_of = medium::nothing;
    std::size_t ack_to = everyone;
    std::uint64_t draws = 0;  // number of random numbers drawn
  };

  Time difs() const { return sifs + 2 * settings_.slot; }
  Time eifs() const { return sifs + air_time(ack_frame, rates[0]) + difs(); }  // after a faulty frame
  Time slots_end(const Station& station) const { return station.counts_from + station.slots * settings_.slot; }

  void fill_agenda(Time since);
  void look_for_jammers(Time since);
  void handle(const medium::Event& event);

  int draw_slots(std::size_t station);
  void start(std::size_t station, Time at);
  void look(std::size_t station, Time at);
  void look_all(Time at);
  void freeze(std::size_t station, Time at);
  void resume(std::size_t station, Time at);
  void send_due(Time at);
  void send_ack(std::size_t station, Time at);
  void put_on_air(std::size_t station, Time at, Time length, std::size_t format, std::uint64_t ack_of, std::size_t to);

  void end_frame(std::uint64_t id, Time at);
  void end_data(const medium::Frame& frame, const std::vector<Heard>& heard, Time at);
  void end_unicast(const medium::Frame& frame, const std::vector<Heard>& heard, Time at);
  void end_wait(std::size_t station, Time at);

  void go_on_with_message(std::size_t station);
  void end_message(std::size_t station);
  void compete(std::size_t station, int window);

  Settings settings_;
  Stream random_;
  medium::Air air_;
  medium::TransmitQueue post_{frames_of};
  medium::EventQueue agenda_;
  std::vector<Station> stations_;
  const Channel* channel_ = nullptr;  // of the run
};

}  // namespace muster::wifi
