// Over the seeds of docs/samples/sweep/target_tracking.xml: robots that look after their link lose fewer messages, and
// the base is less far off, by more than the interval of the paired differences.
#include <gtest/gtest.h>

#include <vector>

#include "tests/worlds/target_tracking/tracked.hpp"

namespace muster::test {
namespace {

struct Outcome {
  double lost, error;
};

Outcome outcome(bool aware, uint64_t seed) {
  Tracked run(aware, seed);
  double sum = 0, count = 0;
  while (!run.done()) {
    run.step();
    const double error = run.known().error;
    if (error == error) sum += error, ++count;  // null before the first message
  }
  return {run.lost(), sum / count};
}

// Lower and upper end of the mean's interval of 99 %, by Student's t of 59 degrees of freedom.
std::pair<double, double> interval(const std::vector<double>& values) {
  double mean = 0, squares = 0;
  for (const double v : values) mean += v / static_cast<double>(values.size());
  for (const double v : values) squares += (v - mean) * (v - mean);
  const double n = static_cast<double>(values.size());
  const double half = 2.662 * std::sqrt(squares / (n - 1) / n);
  return {mean - half, mean + half};
}

TEST(TargetTrackingOverSeeds, AwareRobotsLoseFewerMessagesAndTheBaseErrsLess) {
  std::vector<double> losses, errors;
  for (uint64_t seed = 1; seed <= 60; ++seed) {
    const Outcome aware = outcome(true, seed), unaware = outcome(false, seed);
    losses.push_back(aware.lost - unaware.lost);
    errors.push_back(aware.error - unaware.error);
  }
  EXPECT_LT(interval(losses).second, -0.1);
  EXPECT_LT(interval(errors).second, 0);
}

}  // namespace
}  // namespace muster::test
