// Radios that share one channel by unslotted CSMA/CA (IEEE 802.15.4-2006, 7.5.1.4), frame by frame: who waits, who
// talks over whom, and what becomes of every copy of every message. A discrete-event simulation with events a
// transmission, never a receiver: at a frame's start and end all receivers are looked at in one go.
#pragma once

#include <array>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "muster/random.hpp"
#include "standard.hpp"

namespace muster::lrwpan {

// How a radio listens before it talks. All ask for the power of others against a threshold: its mean over the 8 symbols
// that the standard says; as ns-3 3.37 does it, at their end and whenever a frame begins among them, so that one that
// ends among them goes unnoticed; or at their end alone.
enum class Cca { standard = 1, ns3, instant };

// What may become of a copy, one of which goes to each receiver of a message.
enum class Fate : std::uint8_t {
  under_way = 0,
  delivered,
  too_weak,    // below the receiver's sensitivity, or lost in noise alone
  no_link,     // beyond the range of all links
  collided,    // lost to other frames, or the receiver was talking or heard another one
  no_access,   // the channel was busy each time its sender listened
  queue_full,  // its sender had too many others to send
  no_ack,      // it arrived in part, and the sender gave up for lack of acknowledgements
  gone,        // sender or receiver left
  count
};

struct Settings {
  double noise = 0;  // mW
  double busy = 0;   // power above which the channel is, mW
  Cca cca = Cca::standard;
  std::size_t queue = 16;    // messages that wait at a radio
  bool acknowledged = true;  // frames to one receiver
  int retries = 3;           // macMaxFrameRetries
};

// What the air is like while time passes. Radios by number.
struct Channel {
  std::size_t radios = 0;
  std::vector<double> power;  // mW, [from x radios + to]; 0 where there is no link
  std::vector<double> rssi;   // dBm, the same, as the receiver reports it; NaN where that hears nothing
  std::vector<std::uint8_t> alive;
  std::vector<std::uint64_t> keys;  // of each radio's random numbers

  double from_to(std::size_t from, std::size_t to) const { return power[from * radios + to]; }
};

struct Delivery {
  std::size_t from, to;
  Time sent, received;  // when it was asked for, and when its last frame ended
  double rssi;          // dBm, as that frame's preamble was found
  std::string payload;
};

struct Report {
  std::vector<Delivery> deliveries;
  // Of each sender's copies, by what became of them in this time; under_way counts those newly asked for.
  std::vector<std::array<std::uint64_t, static_cast<std::size_t>(Fate::count)>> fates;
};

class Medium {
 public:
  explicit Medium(const Stream& random) : random_(random) {}

  // Everything that outlives a call of run(): the same bytes make the same future.
  std::string save() const;
  void load(std::string_view bytes);

  // A message that `from` wants to send at `at`, a time of the next run(). `to`: a radio, or `everyone`.
  static constexpr std::size_t everyone = static_cast<std::size_t>(-1);
  void ask(Time at, std::size_t from, std::size_t to, std::string payload);

  // From `since` to `until`.
  Report run(Time since, Time until, const Channel& channel, const Settings& settings);

 private:
  enum class Phase : std::uint8_t { idle, backing_off, turning, sending, settling, awaiting_ack };
  static constexpr Time never = INT64_MAX;
  static constexpr std::uint64_t nothing = 0;  // no frame

  struct Message {
    Time asked;
    std::size_t to;
    std::string payload;
    std::vector<Fate> fates;  // one a radio; `count` for those that it does not go to
  };

  // What a radio does about the first message of its queue, and about what it hears meanwhile.
  struct Radio {
    std::deque<Message> queue;
    std::size_t frame = 0;  // of the message
    Phase phase = Phase::idle;
    Time due = never;  // when the phase ends by itself
    Time spaced = 0;   // before it nothing is sent
    int backoffs = 0, exponent = 0, tries = 0;
    std::uint64_t sent = nothing;     // its last frame
    bool arrived = false;             // the frame, at its one receiver
    Fate last_loss = Fate::too_weak;  // of the frame, there

    // An acknowledgement that it owes.
    Phase ack_phase = Phase::idle;
    Time ack_due = never;
    std::uint64_t ack_of = nothing;
    std::size_t ack_to = everyone;

    // The frame that it listens to.
    std::uint64_t lock = nothing;
    double rssi = 0;       // dBm
    double log_whole = 0;  // of the probability that all bits came right so far
    bool disturbed = false;
    Time heard_until = 0;

    std::uint64_t draws = 0;  // random numbers used up
  };

  // In the air, or gone for less than a CCA's window.
  struct Frame {
    std::uint64_t id;
    std::size_t sender;
    Time begin, end;
    std::uint64_t ack_of;  // the frame that it acknowledges, or nothing
    std::size_t ack_to;    // and whose that was
  };

  struct Request {
    Time at;
    std::size_t from, to;
    std::string payload;
  };

  struct Event {
    Time at;
    int kind;  // those at the same time: frames end, requests come, phases end, acknowledgements go on
    std::size_t which;
    bool operator>(const Event& b) const {
      return at != b.at ? at > b.at : kind != b.kind ? kind > b.kind : which > b.which;
    }
  };

  void schedule(Time at, int kind, std::size_t which);
  void wait(std::size_t radio, Phase phase, Time until);
  void wait_with_ack(std::size_t radio, Phase phase, Time until);
  double draw(std::size_t radio);
  static bool listens(const Radio& radio);
  double power_at(std::size_t radio, Time at) const;
  bool is_busy(std::size_t radio, Time at) const;

  void handle(const Event& event);
  void take_request(Request& request);
  void compete(std::size_t radio, Time at);
  void back_off(std::size_t radio, Time from);
  void assess(std::size_t radio, Time at);
  void end_phase(std::size_t radio, Time at);
  void end_ack_phase(std::size_t radio, Time at);

  void begin_frame(std::size_t sender, Time at, Time length, std::uint64_t ack_of, std::size_t ack_to);
  void hear(std::size_t radio, Time until);
  Fate heard_by(std::size_t radio, const Frame& frame);
  void end_frame(std::uint64_t id, Time at);
  void end_broadcast(std::size_t sender, Time at, const std::vector<Fate>& heard);
  void end_unicast(const Frame& frame, Time at, Fate heard);

  bool is_last_frame(const Radio& radio) const;
  void go_on_with_message(std::size_t sender, Time at);
  void give_up(std::size_t sender, Fate why, Time at);
  void end_message(std::size_t sender, Time at);
  void settle(std::size_t sender, Message& message, std::size_t to, Fate fate);
  void deliver(std::size_t sender, Message& message, std::size_t to, Time at);
  void forget_the_gone();

  Settings settings_;
  Stream random_;
  std::vector<Radio> radios_;
  std::vector<Frame> air_;
  std::uint64_t frames_ = nothing;  // begun so far
  std::vector<Request> requests_;

  // Of the run.
  const Channel* channel_ = nullptr;
  Report* report_ = nullptr;
  Time until_ = 0;
  std::vector<Event> events_;  // a heap
};

}  // namespace muster::lrwpan
