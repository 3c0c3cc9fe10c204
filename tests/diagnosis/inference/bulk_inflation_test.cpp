// Inflation of the bulk of gains: none in noise that the model holds, found in noise that it does not.
#include "diagnosis/inference/score/bulk_inflation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "muster/random.hpp"
#include "tests/diagnosis/inference/causes.hpp"

namespace muster::inference {
namespace {

using synthetic::causes_of;
using synthetic::problem_of;
using synthetic::varied;
using synthetic::world_of;

const Candidate& called(const std::vector<Candidate>& all, const std::string& id) {
  return *std::find_if(all.begin(), all.end(), [&](const Candidate& c) { return c.id == id; });
}

// `effect` [dB]: one a reading.
double inflation_in_time(const synthetic::World& world, const Eigen::VectorXd& effect) {
  const auto causes = causes_of(world);
  const Problem problem = problem_of(world, effect, causes);
  ModelState state(problem, {});
  const Candidate& step = called(causes, "step");
  const Eigen::VectorXd& theta = step.design.grid[step.design.grid.size() / 2];
  const Eigen::MatrixXd columns = state.columns_of(step, theta);
  Eigen::MatrixXd design(state.rows().size(), state.base().cols() + 1);
  design << state.base(), columns;
  return bulk_inflation(state, state.whitened_model(design), step, columns);
}

TEST(BulkInflation, IsOneInWhiteNoise) {
  int higher = 0;
  for (uint64_t seed = 1; seed <= 12; ++seed) {
    const auto world = world_of(varied(seed, 3000));
    higher += inflation_in_time(world, Eigen::VectorXd::Zero(world.rssi.size())) > 1;
  }
  EXPECT_LE(higher, 2);
}

// A level that all links share wanders over minutes, which no field over places holds: functions of time of all kinds
// gain alike.
TEST(BulkInflation, IsThatOfALevelThatWandersInTime) {
  const auto world = world_of(varied(3, 3000));
  const Stream stream(5);
  Eigen::VectorXd wander(world.rssi.size());
  const double step = 20;  // s
  for (Index i = 0; i < wander.size(); ++i) wander[i] = 2 * stream.normal(static_cast<uint64_t>(world.time[i] / step));
  EXPECT_GT(inflation_in_time(world, wander), 2);
}

}  // namespace
}  // namespace muster::inference
