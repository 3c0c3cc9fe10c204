// The pace of a run, by a clock that the test moves: no test waits.
#include "cli/pacing.hpp"

#include <gtest/gtest.h>

#include <vector>

using muster::cli::Pacing;

namespace {

class MovedClock : public muster::cli::WallClock {
 public:
  double now() override { return now_; }
  void sleep_until(double moment) override {
    slept_.push_back(moment - now_);
    now_ = moment;
  }
  void pass(double seconds) { now_ += seconds; }
  const std::vector<double>& slept() const { return slept_; }

 private:
  double now_ = 1000;
  std::vector<double> slept_;
};

// A run of n ticks, each of which costs the computer so many seconds.
void run(Pacing& pacing, MovedClock& clock, int first, int last, double dt, double cost) {
  for (int tick = first; tick < last; ++tick) {
    clock.pass(cost);
    pacing.wait((tick + 1) * dt);
  }
}

TEST(Pacing, SimulatedTimeTakesAsLongDividedBySpeed) {
  for (const double speed : {0.25, 1.0, 8.0}) {
    MovedClock clock;
    const double began = clock.now();
    Pacing pacing(clock, speed, 0);
    run(pacing, clock, 0, 200, 0.01, 0.0003);
    EXPECT_NEAR(clock.now() - began, 2 / speed, 1e-9);
    EXPECT_EQ(clock.slept().size(), 200u);
    EXPECT_EQ(pacing.most_late(), 0);
    EXPECT_EQ(pacing.warning(0.01), "");
  }
}

TEST(Pacing, BeginsWhereTheRunBegins) {
  MovedClock clock;
  Pacing pacing(clock, 1, 30);  // restored at 30 s
  pacing.wait(30.5);
  EXPECT_NEAR(clock.now(), 1000.5, 1e-9);
}

TEST(Pacing, ASlowComputerIsNamedWithHowLateItIs) {
  MovedClock clock;
  Pacing pacing(clock, 2, 0);
  run(pacing, clock, 0, 100, 0.01, 0.006);  // 0.6 s for 0.5 s
  EXPECT_TRUE(clock.slept().empty());
  EXPECT_NEAR(pacing.late(), 0.1, 1e-9);
  EXPECT_EQ(pacing.warning(0.01),
            "not in real time: this computer was up to 0.1 s late at --speed 2, 0.1 s at the end");
}

TEST(Pacing, ALateRunCatchesUpAndSaysThatItWasLate) {
  MovedClock clock;
  Pacing pacing(clock, 1, 0);
  clock.pass(0.25);
  run(pacing, clock, 0, 100, 0.01, 0.001);
  EXPECT_NEAR(clock.now(), 1001, 1e-9);
  EXPECT_EQ(pacing.late(), 0);
  EXPECT_EQ(pacing.warning(0.01),
            "not in real time: this computer was up to 0.241 s late at --speed 1, 0 s at the end");
}

TEST(Pacing, LateByLessThanATickIsNotLate) {
  MovedClock clock;
  Pacing pacing(clock, 1, 0);
  clock.pass(0.09);
  pacing.wait(0.01);
  EXPECT_NEAR(pacing.most_late(), 0.08, 1e-9);
  EXPECT_EQ(pacing.warning(0.1), "");
  EXPECT_NE(pacing.warning(0.05), "");
}

TEST(Pacing, AfterAPauseTheClockBeginsAnew) {
  MovedClock clock;
  Pacing pacing(clock, 1, 0);
  run(pacing, clock, 0, 10, 0.1, 0.01);
  clock.pass(3600);
  pacing.restart(4, 1);
  run(pacing, clock, 10, 30, 0.1, 0.01);
  EXPECT_NEAR(clock.now(), 1000 + 1 + 3600 + 0.5, 1e-9);
  EXPECT_EQ(pacing.most_late(), 0);
}

TEST(Pacing, ASleeperWakesWhenTheRunIsToEnd) {
  int looks = 0;
  muster::cli::SteadyClock clock([&] { return ++looks > 1; });
  const double began = clock.now();
  clock.sleep_until(began + 3600);
  EXPECT_EQ(looks, 2);
}

}  // namespace
