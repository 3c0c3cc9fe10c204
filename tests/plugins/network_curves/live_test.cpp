// ns-3 itself and our media on the same places and moments, in one run.
#include <gtest/gtest.h>

#include "cases.hpp"
#include "peers/ns3.hpp"

namespace muster::peers {
namespace {

void compare(Case c, unsigned runs, double within, const std::function<Counts(const Task&)>& ns3) {
  c.runs = runs;
  const Curve theirs = mean_of(c, ns3), ours = mean_of(c, [&](const Task&t) { return c.ours(t); });
  std::printf("arrived %.4f (%.4f), no access %.4f (%.4f)\n", ours.arrived, theirs.arrived, ours.no_access,
              theirs.no_access);
  EXPECT_NEAR(ours.arrived, theirs.arrived, within);
  EXPECT_NEAR(ours.no_access, theirs.no_access, 0.01);
}

TEST(Live, LrWpanUnderLoad) { compare({"lr_wpan", "load", 30, 12, 10, 0}, 3, 0.02, ns3_lr_wpan); }
TEST(Live, LrWpanInNoise) { compare({"lr_wpan", "noise", 2, 185, 25, 0}, 3, 0.03, ns3_lr_wpan); }
// One saturated device in superframes waits 3.5 periods in the mean, assesses, sends for 10, and keeps its spacing
// of 2. ns-3 makes both assessments within one period, the standard (7.5.1.4) and our medium in two; and it goes on
// from a busy channel without regard to the periods, so with several devices its curve is another one. Between 16.5 and
// 17.1 periods have been seen, by which of its random streams the devices have.
TEST(Live, SlottedLrWpanAssessesWithinOnePeriod) {
  Task task;
  task.places = {{0, 0}, {5, 0}};
  task.payload = 83;
  task.seconds = 21;
  const double cycles = static_cast<double>(ns3_star(task, 8).arrived) * 320e-6 / 20;
  std::printf("a frame in %.2f periods\n", 1 / cycles);
  EXPECT_GT(1 / cycles, 3.5 + 1 + 10 + 2 - 0.3);
  EXPECT_LT(1 / cycles, 3.5 + 2 + 10 + 2 - 0.3);
}

TEST(Live, WifiUnderLoad) {
  compare({"wifi", "load", 20, 150, 0.5, 0}, 3, 0.02, [](const Task& t) { return ns3_wifi(t, 6); });
}

}  // namespace
}  // namespace muster::peers
