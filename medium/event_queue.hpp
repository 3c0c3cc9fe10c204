// Event queue of one run of a medium.
#pragma once

#include <algorithm>
#include <functional>
#include <vector>

#include "medium/channel.hpp"

namespace muster::medium {

// Packed in two words: compared and moved very often.
struct Event {
  Time at;
  std::uint64_t what;  // orders simultaneous events by kind, then by number

  Event(Time when, int kind, std::uint64_t number)
      : at(when), what(static_cast<std::uint64_t>(kind) << number_bits | number) {}
  int kind() const { return static_cast<int>(what >> number_bits); }
  std::uint64_t number() const { return what & ((std::uint64_t{1} << number_bits) - 1); }
  bool operator>(const Event& b) const { return at != b.at ? at > b.at : what > b.what; }

  static constexpr int number_bits = 56;
};

// Events known before the run are sorted once; those that arise in it go into a heap, which stays small.
class EventQueue {
 public:
  void clear(Time until) {
    known_.clear(), heap_.clear();
    next_ = 0;
    has_begun_ = false;
    until_ = until;
  }
  // Drops events beyond the run: the medium's state reproduces them for the next one.
  void put(Time at, int kind, std::uint64_t number) {
    if (at >= until_) return;
    auto& events = has_begun_ ? heap_ : known_;
    events.emplace_back(at, kind, number);
    if (has_begun_) std::push_heap(events.begin(), events.end(), std::greater<>());
  }
  void begin() {
    std::sort(known_.begin(), known_.end(), [](const Event& a, const Event& b) { return b > a; });
    has_begun_ = true;
  }
  bool empty() const { return heap_.empty() && next_ == known_.size(); }
  Event take() {
    if (heap_.empty() || (next_ < known_.size() && heap_.front() > known_[next_])) return known_[next_++];
    std::pop_heap(heap_.begin(), heap_.end(), std::greater<>());
    const Event next = heap_.back();
    heap_.pop_back();
    return next;
  }

 private:
  Time until_ = 0;
  bool has_begun_ = false;
  std::size_t next_ = 0;
  std::vector<Event> known_, heap_;
};

}  // namespace muster::medium
