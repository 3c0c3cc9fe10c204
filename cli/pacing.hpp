// Paces a run by the clock on the wall: a tick at time t ends no earlier than t / speed after the start.
#pragma once

#include <functional>
#include <string>

namespace muster::cli {

class WallClock {
 public:
  virtual ~WallClock() = default;
  virtual double now() = 0;  // [s] since any fixed moment
  // Returns at that moment, or earlier where the run is to end.
  virtual void sleep_until(double moment) = 0;
};

// The computer's steady clock. A sleep ends soon after `is_over` does.
class SteadyClock : public WallClock {
 public:
  explicit SteadyClock(std::function<bool()> is_over) : is_over_(std::move(is_over)) {}
  double now() override;
  void sleep_until(double moment) override;

 private:
  std::function<bool()> is_over_;
};

class Pacing {
 public:
  // From now on, where the run is at `time`.
  Pacing(WallClock& clock, double speed, double time) : clock_(clock) { restart(speed, time); }

  // After a pause, or at another speed.
  void restart(double speed, double time);
  // Returns when the clock has come to `time`; at once where it has passed it. A late run catches up by itself.
  void wait(double time);

  double speed() const { return speed_; }
  double late() const { return late_; }            // [s] of the clock, at the last wait()
  double most_late() const { return most_late_; }  // [s] of the clock, at any wait()
  // What the user is to know of a run with ticks of dt; empty where it kept up.
  std::string warning(double dt) const;

 private:
  WallClock& clock_;
  double speed_ = 1, began_ = 0, time_ = 0, late_ = 0, most_late_ = 0;
};

}  // namespace muster::cli
