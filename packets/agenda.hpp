// What happens when, within one run of a medium.
#pragma once

#include <algorithm>
#include <functional>
#include <vector>

#include "packets/channel.hpp"

namespace muster::packets {

struct Event {
  Time at;
  int kind;  // of those at the same time, the lower kind comes first, then the lower `which`
  std::uint64_t which;

  bool operator>(const Event& b) const {
    return at != b.at ? at > b.at : kind != b.kind ? kind > b.kind : which > b.which;
  }
};

class Agenda {
 public:
  void clear(Time until) {
    heap_.clear();
    until_ = until;
  }
  // What lies beyond the run is left out: the medium's state tells it to the next one.
  void put(Time at, int kind, std::uint64_t which) {
    if (at >= until_) return;
    heap_.push_back({at, kind, which});
    std::push_heap(heap_.begin(), heap_.end(), std::greater<>());
  }
  bool empty() const { return heap_.empty(); }
  Event take() {
    std::pop_heap(heap_.begin(), heap_.end(), std::greater<>());
    const Event next = heap_.back();
    heap_.pop_back();
    return next;
  }

 private:
  Time until_ = 0;
  std::vector<Event> heap_;
};

}  // namespace muster::packets
