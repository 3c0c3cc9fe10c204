// Notices a plugin's callback that does not return: a run that hangs says nothing of who holds it up.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace muster {

// The callback that a thread is in.
struct CallbackAt {
  const char* title = nullptr;  // null: none, or one that may wait
  const char* callback = "";
  int64_t tick = -1;  // negative outside a step
  double time = 0;    // [s] of the run
};

// For the thread that calls it; a few stores. A title must stay where it is until settle_callback_watch() has returned
// after the callback's end.
void note_callback(const CallbackAt& at) noexcept;

// Waits for a look at callbacks that may be reading a title. Before a title goes.
void settle_callback_watch();

// Notes about callbacks that have not returned.
class CallbackWatch {
 public:
  // Words on each thread's callback that has lasted for 10 s since a look first met it, for 20 s, 40 s, and then each
  // minute more. `now` is of any clock that does not go back.
  std::vector<std::string> look(std::chrono::milliseconds now);

 private:
  struct Met {
    const void* thread;
    uint64_t entered;
    std::chrono::milliseconds since, due;
  };
  std::vector<Met> met_;
};

// From the next callback of this process on, a thread looks once a second and writes such notes to standard error.
void watch_callbacks();

}  // namespace muster
