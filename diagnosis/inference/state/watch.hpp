// Lets the caller of a long search follow its progress and end it early.
#pragma once

#include <functional>
#include <string>

namespace muster::inference {

struct Watch {
  std::function<void(const std::string& now)> told{};  // called with what is being done. Empty: nobody listens
  std::function<bool()> stopped{};  // asked between steps. True: end with what is known so far. Empty: never

  void at(const std::string& now) const {
    if (told) told(now);
  }
  bool stop() const { return stopped && stopped(); }
};

}  // namespace muster::inference
