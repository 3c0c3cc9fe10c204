// Pending messages: each radio's transmit queue, and the delivery outcome of every copy. A medium access takes the
// first message of a queue, sends its frames, and reports their outcomes here.
#pragma once

#include <array>
#include <deque>
#include <string>
#include <vector>

#include "medium/air.hpp"

namespace muster::medium {

// Outcomes of a copy; one copy goes to each receiver of a message.
enum class DeliveryOutcome : std::uint8_t {
  under_way = 0,
  delivered,
  too_weak,    // below the receiver's sensitivity, or lost in noise alone
  no_link,     // beyond the range of all links
  collided,    // lost to interference, or the receiver was sending or receiving another frame
  no_access,   // the channel was busy at each carrier sense
  queue_full,  // its sender's queue was full
  no_ack,      // it arrived in part, and its sender gave up for lack of acknowledgements
  gone,        // sender or receiver left
  count
};
DeliveryOutcome fate_of(Heard heard);

constexpr std::size_t everyone = static_cast<std::size_t>(-1);

// Set of receivers whose copy of a message is still under way.
class Receivers {
 public:
  Receivers() = default;
  explicit Receivers(std::size_t one) : count_(1), one_(one) {}
  explicit Receivers(std::vector<std::uint8_t> all) : all_(std::move(all)) {
    for (const std::uint8_t is_one : all_) count_ += is_one;
  }

  std::size_t count() const { return count_; }
  bool has(std::size_t radio) const { return radio == one_ || (radio < all_.size() && all_[radio]); }
  // In the order of their numbers.
  template <class Do>
  void each(Do&& what) const {
    if (one_ != everyone) what(one_);
    for (std::size_t i = 0; i < all_.size(); ++i)
      if (all_[i]) what(i);
  }
  void drop(std::size_t radio) {
    --count_;
    if (radio == one_) one_ = everyone;
    if (radio < all_.size()) all_[radio] = false;
  }
  void save(Writer& out) const { out.put(count_), out.put(one_), out.put_all(all_); }
  void load(Reader& in) { in.get(count_), in.get(one_), in.get_all(all_); }

 private:
  std::size_t count_ = 0, one_ = everyone;
  std::vector<std::uint8_t> all_;
};

struct Message {
  Time asked = 0;
  std::size_t to = everyone;
  std::size_t size = 0;  // bytes
  std::string payload;   // until its first copy is delivered
  Receivers receivers;
  std::size_t frame = 0;  // the one being sent
};

// A message received by some radio.
struct Arrival {
  std::size_t from;
  Time sent, received;  // of the request, and of its last frame's end
  std::string payload;
};

struct Delivery {
  std::uint32_t arrival, to;  // index of its arrival in the report; a radio
  double rssi, ratio;         // of its last frame: dBm at its preamble; ratio to noise and others

  // Constructed in place: copying what was just written would stall.
  Delivery(std::uint32_t a, std::uint32_t receiver, double dbm, double r)
      : arrival(a), to(receiver), rssi(dbm), ratio(r) {}
};

struct Report {
  std::vector<Arrival> arrivals;
  std::vector<Delivery> deliveries;
  // Of each sender's copies, counts of outcomes in this run; under_way counts those newly requested.
  std::vector<std::array<std::uint64_t, static_cast<std::size_t>(DeliveryOutcome::count)>> fates;
};

class TransmitQueue {
 public:
  // `frames_of`: number of frames for a payload of so many bytes; null where a medium counts them itself.
  explicit TransmitQueue(std::size_t (*frames_of)(std::size_t) = nullptr) : frames_of_(frames_of) {}

  // Adds a message that `from` is to send at a time of the next run.
  void ask(Time at, std::size_t from, std::size_t to, std::string payload);

  struct Request {
    Time at;
    std::size_t from, to;
    std::string payload;
  };
  const std::vector<Request>& requests() const { return requests_; }

  // Starts a run; first settles all messages of radios that left.
  void open(const Channel& channel);
  const Report& close();
  // Puts a request into its sender's queue, which holds at most `limit`. True if it is to be sent at once.
  bool take(std::size_t request, std::size_t limit);

  bool is_waiting(std::size_t radio) const { return !queues_[radio].empty(); }
  Message& first(std::size_t radio) { return queues_[radio].front(); }
  const Message& first(std::size_t radio) const { return queues_[radio].front(); }
  bool is_last_frame(std::size_t radio) const { return first(radio).frame + 1 >= frames_of_(first(radio).size); }
  void drop_first(std::size_t radio) { queues_[radio].pop_front(); }

  // Records the outcome of a frame of the first message at each receiver whose copy is under way. The last frame
  // settles each copy, and delivers those that arrived.
  void frame_heard(std::size_t sender, const std::vector<Heard>& heard);
  void last_frame_heard(std::size_t sender, const std::vector<Heard>& heard, const Air& air, Time at);
  void deliver(std::size_t sender, std::size_t to, const Air& air, Time at);
  // Settles all copies of the first message that are under way.
  void settle(std::size_t sender, DeliveryOutcome fate) { settle(sender, first(sender), fate); }

  void save(Writer& out) const;
  void load(Reader& in);

 private:
  void settle(std::size_t sender, Message& message, DeliveryOutcome fate);
  void count(std::size_t sender, DeliveryOutcome fate, std::size_t copies = 1) {
    report_.fates[sender][static_cast<std::size_t>(fate)] += copies;
  }
  void put_delivery(std::size_t to, const Air& air);
  void put_arrival(std::size_t sender, Time at);

  std::size_t (*frames_of_)(std::size_t);
  const Channel* channel_ = nullptr;
  std::vector<std::deque<Message>> queues_;
  std::vector<Request> requests_;
  Report report_;
};

}  // namespace muster::medium
