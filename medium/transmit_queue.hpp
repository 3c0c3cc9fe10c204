// Messages on their way: who wants to send what to whom, each radio's queue, and what became of every copy. A medium
// access takes the first message of a queue, sends its frames, and says here what became of them.
#pragma once

#include <array>
#include <deque>
#include <string>
#include <vector>

#include "medium/air.hpp"

namespace muster::medium {

// What may become of a copy, one of which goes to each receiver of a message.
enum class Fate : std::uint8_t {
  under_way = 0,
  delivered,
  too_weak,    // below the receiver's sensitivity, or lost in noise alone
  no_link,     // beyond the range of all links
  collided,    // lost to what else was in the air, or the receiver was talking or heard another one
  no_access,   // the channel was busy each time its sender listened
  queue_full,  // its sender had too many others to send
  no_ack,      // it arrived in part, and the sender gave up for lack of acknowledgements
  gone,        // sender or receiver left
  count
};
Fate fate_of(Heard heard);

constexpr std::size_t everyone = static_cast<std::size_t>(-1);

// Those to whom a copy of a message is still under way.
class Receivers {
 public:
  Receivers() = default;
  explicit Receivers(std::size_t one) : count_(1), one_(one) {}
  explicit Receivers(std::vector<std::uint8_t> all) : all_(std::move(all)) {
    for (const std::uint8_t is_one : all_) count_ += is_one;
  }

  std::size_t count() const { return count_; }
  bool has(std::size_t radio) const { return radio == one_ || (radio < all_.size() && all_[radio]); }
  // In order of their numbers.
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
  std::size_t frame = 0;  // the one that is sent
};

// A message that arrived at somebody.
struct Arrival {
  std::size_t from;
  Time sent, received;  // when it was asked for, and when its last frame ended
  std::string payload;
};

struct Delivery {
  std::uint32_t arrival, to;  // its number in the report; a radio
  double rssi, ratio;         // of its last frame: dBm as its preamble was found; signal to noise and others

  // Where it is to stand: a copy of what was just written would wait for that.
  Delivery(std::uint32_t a, std::uint32_t receiver, double dbm, double r)
      : arrival(a), to(receiver), rssi(dbm), ratio(r) {}
};

struct Report {
  std::vector<Arrival> arrivals;
  std::vector<Delivery> deliveries;
  // Of each sender's copies, by what became of them in this time; under_way counts those newly asked for.
  std::vector<std::array<std::uint64_t, static_cast<std::size_t>(Fate::count)>> fates;
};

class Post {
 public:
  // `frames_of`: how many frames a payload of so many bytes goes in; where a medium counts them itself, none.
  explicit Post(std::size_t (*frames_of)(std::size_t) = nullptr) : frames_of_(frames_of) {}

  // A message that `from` wants to send at a time of the next run.
  void ask(Time at, std::size_t from, std::size_t to, std::string payload);

  struct Request {
    Time at;
    std::size_t from, to;
    std::string payload;
  };
  const std::vector<Request>& requests() const { return requests_; }

  // Of a run, which begins by settling all that radios which left had to send.
  void open(const Channel& channel);
  const Report& close();
  // Puts a request into its sender's queue, where no more than `limit` may wait. True if it is to be sent at once.
  bool take(std::size_t request, std::size_t limit);

  bool is_waiting(std::size_t radio) const { return !queues_[radio].empty(); }
  Message& first(std::size_t radio) { return queues_[radio].front(); }
  const Message& first(std::size_t radio) const { return queues_[radio].front(); }
  bool is_last_frame(std::size_t radio) const { return first(radio).frame + 1 >= frames_of_(first(radio).size); }
  void drop_first(std::size_t radio) { queues_[radio].pop_front(); }

  // What became of a frame of the first message, at each receiver that it is still under way to. With the last frame
  // each copy is settled, and delivered where it arrived.
  void frame_heard(std::size_t sender, const std::vector<Heard>& heard);
  void last_frame_heard(std::size_t sender, const std::vector<Heard>& heard, const Air& air, Time at);
  void deliver(std::size_t sender, std::size_t to, const Air& air, Time at);
  // All copies of the first message that are under way.
  void settle(std::size_t sender, Fate fate) { settle(sender, first(sender), fate); }

  void save(Writer& out) const;
  void load(Reader& in);

 private:
  void settle(std::size_t sender, Message& message, Fate fate);
  void count(std::size_t sender, Fate fate, std::size_t copies = 1) {
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
