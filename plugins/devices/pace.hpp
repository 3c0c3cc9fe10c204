// The pace of hardware: a tick at time t of the run ends no earlier than its moment on the wall's clock.
#pragma once

#include <ctime>
#include <stdexcept>

namespace muster::devices {

struct Interrupted : std::runtime_error {
  Interrupted() : std::runtime_error("interrupted while it waited") {}
};

class Clock {
 public:
  virtual ~Clock() = default;
  virtual double now() = 0;                // [s] since any fixed moment
  virtual void sleep(double seconds) = 0;  // throws Interrupted at a signal
};

class SteadyClock : public Clock {
 public:
  double now() override {
    timespec time{};
    ::clock_gettime(CLOCK_MONOTONIC, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }
  void sleep(double seconds) override {
    const auto whole = static_cast<std::time_t>(seconds);
    const timespec time{whole, static_cast<long>((seconds - static_cast<double>(whole)) * 1e9)};
    if (::nanosleep(&time, nullptr) != 0) throw Interrupted{};
  }
};

// A run that is late catches up, unless it is later than `most`: a robot has gone on meanwhile, and ticks in a burst
// would steer it by what it no longer does.
class Pace {
 public:
  explicit Pace(Clock& clock) : clock_(clock) {}
  // Returns when the clock has come to `time` of the run, which is `speed` times as fast. Returns how late it was where
  // that is more than `most` [s], and not made up; else 0.
  double wait(double time, double speed, double most) {
    const double now = clock_.now();
    if (speed != speed_) begin(speed_ == 0 ? time : last_, now);  // it may be changed in mid-run
    speed_ = speed;
    last_ = time;
    const double due = began_ + (time - time_) / speed;
    if (now > due + most) {
      begin(time, now);
      return now - due;
    }
    if (now < due) clock_.sleep(due - now);
    return 0;
  }

 private:
  void begin(double time, double now) {
    began_ = now;
    time_ = time;
  }
  Clock& clock_;
  double speed_ = 0, began_ = 0, time_ = 0, last_ = 0;  // speed 0: it has not begun. last: [s] of the run
};

}  // namespace muster::devices
