// Names the plugin whose code a signal ends: without it a segmentation fault says nothing of who is at fault.
#pragma once

#include <cstdint>

namespace muster {

// The callback that runs on this thread, for the length of this object's life.
class RunningCallback {
 public:
  // `title` and `callback` must outlive it; `tick` is negative outside a step. One that `may_wait`, for a client or a
  // clock, is not told of when it lasts long.
  RunningCallback(const char* title, const char* callback, int64_t tick, double time = 0, bool may_wait = false);
  ~RunningCallback();
  RunningCallback(const RunningCallback&) = delete;
  RunningCallback& operator=(const RunningCallback&) = delete;

 private:
  void note() const;
  friend void write_crash(int signal);
  friend bool write_exit();
  const char *title_, *callback_;
  int64_t tick_;
  double time_;
  bool may_wait_;
  const RunningCallback* outer_;
};

// "a segmentation fault (SIGSEGV)"
const char* words_of_signal(int signal);

// From now on a signal such as SIGSEGV in a plugin's code writes one line, "muster: error: TITLE: ...", to standard
// error, and then ends the process as before; exit() and _exit() in a callback do so, too, and end the process with 3.
// Signals that something else handles, such as a sanitizer, are left to it.
void report_crashes();

// For a copy of this process whose parent tells how it ended: neither is reported any more.
void leave_crashes_to_parent();

}  // namespace muster
