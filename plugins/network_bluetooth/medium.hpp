// A piconet: one master, at most seven slaves, slots of 625 us. The master polls its slaves in turn; a slave sends only
// in the slot after a packet addressed to it. Lost packets are repeated. A discrete-event simulation of every packet.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "medium/air.hpp"
#include "medium/event_queue.hpp"
#include "medium/transmit_queue.hpp"
#include "standard.hpp"

namespace muster::bluetooth {

using medium::Channel;
using medium::DeliveryOutcome;
using medium::Heard;
using medium::Report;

struct Settings {
  static constexpr std::size_t first_there = static_cast<std::size_t>(-1);
  std::size_t master = 0;          // or first_there: the first radio that is there and does not jam
  std::size_t largest = dh5;       // packets
  Time poll_interval = 40 * slot;  // T_poll: longest interval between packets to a slave
  Time flush = 80 * slot;  // time after its first chance to be sent at which an unacknowledged packet is dropped
  double noise = 0;        // mW
  std::size_t queue = 64;  // limit of messages in a radio's queue
};

// `there`: the radios that may belong to the piconet, by index.
struct NoPiconet : std::runtime_error {
  NoPiconet(const std::string& why, std::vector<std::size_t> radios)
      : std::runtime_error(why), there(std::move(radios)) {}
  std::vector<std::size_t> there;
};

struct TooManyRadios : NoPiconet {
  using NoPiconet::NoPiconet;
};

struct JammingMaster : NoPiconet {
  using NoPiconet::NoPiconet;
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

  // Runs from `since` to `until`. The report is valid until the next run. All radios except jammers belong to the
  // piconet; throws TooManyRadios if these are more than a master and seven slaves, and
  // JammingMaster.
  const Report& run(Time since, Time until, const Channel& channel, const Settings& settings);

  // Channel of the slot that begins at this time, 0 to 78.
  int channel_at(Time at) const;

 private:
  struct Radio {
    // Of its first message: octets acknowledged, and octets in the next packet.
    std::size_t done = 0, carried = 0;
    std::uint64_t sent = medium::nothing;  // the frame that carried the packet last
    Time sent_until = 0;
    bool arrived = false;
    DeliveryOutcome last_loss = DeliveryOutcome::too_weak;
    Time expires = medium::never;

    // As a slave: when it was last addressed, until when the master expects more data from it, its last data that the
    // master received, and when it answers to which frame.
    Time addressed = -(Time{1} << 40);
    Time has_more_until = 0;
    std::uint64_t heard = medium::nothing;
    Time answers = medium::never;
    std::uint64_t answers_to = medium::nothing;
  };

  void choose_master();
  std::vector<std::size_t> members() const;
  void look_who_is_there();
  bool is_linked(std::size_t one, std::size_t other) const;
  void handle(const medium::Event& event);

  void take_turn(Time at);
  Time wants_turn(std::size_t radio, Time at) const;
  void wake(Time at);
  void wait_for_turn(Time at);
  void answer(std::size_t slave, Time at);
  std::size_t put_on_air(std::size_t from, std::size_t to, Time at, std::uint64_t ack_of);

  void end_frame(std::uint64_t id, Time at);
  void end_broadcast(std::size_t sender, const std::vector<Heard>& heard, Time at);
  void end_down(const medium::Frame& frame, Heard heard, Time at);
  void end_up(const medium::Frame& frame, Heard heard, Time at);
  void arrive(std::size_t from, std::size_t to, Time at);
  void acknowledge(std::size_t from, std::uint64_t frame, Time at);
  void expire(std::size_t radio, Time at);

  bool has_for(std::size_t from, std::size_t to) const;
  std::size_t rest(std::size_t sender) const;
  bool is_last_packet(std::size_t sender) const { return radios_[sender].carried == rest(sender); }
  bool settle_unreachable(std::size_t sender);
  void begin_message(std::size_t sender, Time at);
  void begin_packet(std::size_t sender, Time at);
  void go_on_with_message(std::size_t sender, Time at);

  Settings settings_;
  Stream random_;
  medium::Air air_;
  medium::TransmitQueue post_;
  medium::EventQueue agenda_;
  std::vector<Radio> radios_;
  Time free_ = 0;                       // until then the channel may be in use
  Time turn_ = 0;                       // time of the master's next decision
  const Channel* channel_ = nullptr;    // of the run
  std::vector<std::uint8_t> is_there_;  // of each radio: member of the piconet
};

}  // namespace muster::bluetooth
