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
  Pace(Clock& clock, double speed, double most) : clock_(clock), speed_(speed), most_(most) {}
  // Returns when the clock has come to `time` of the run. Returns how late it was where the rest is not made up, else
  // 0.
  double wait(double time) {
    const double now = clock_.now();
    if (!has_begun_) begin(time, now);
    const double due = began_ + (time - time_) / speed_;
    if (now > due + most_) {
      begin(time, now);
      return now - due;
    }
    if (now < due) clock_.sleep(due - now);
    return 0;
  }

 private:
  void begin(double time, double now) {
    has_begun_ = true;
    began_ = now;
    time_ = time;
  }
  Clock& clock_;
  double speed_, most_, began_ = 0, time_ = 0;
  bool has_begun_ = false;
};

}  // namespace muster::devices
