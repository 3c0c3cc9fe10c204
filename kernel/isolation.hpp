// Which instances step in a process of their own, and what is done when one of these ends.
#pragma once

#include <chrono>
#include <map>
#include <string>

namespace muster {

enum class AfterCrash {
  stop,     // the run ends, with the plugin named
  restart,  // a new process takes the step again; the run ends where that ends, too
  without   // the run goes on without the instance
};

struct Isolation {
  AfterCrash after = AfterCrash::stop;
  std::chrono::milliseconds limit{30'000};  // of one callback; a process that takes longer is ended
};

// By the instance's name; "*" is every instance that is not named.
using Isolations = std::map<std::string, Isolation>;

}  // namespace muster
