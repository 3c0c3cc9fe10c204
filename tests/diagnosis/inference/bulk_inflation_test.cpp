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

// Three of four transmitters are off. Ways of saying so are many, but only three of them are independent: all gain
// beside the first that is named, and are no measure of chance.
TEST(BulkInflation, IsNotOfAFewThatHaveEffects) {
  synthetic::Recipe recipe = varied(4, 3000);
  recipe.transmitters = 4;
  const auto world = world_of(recipe);
  const auto is_of = [&](int transmitter) -> Eigen::VectorXd {
    Eigen::VectorXd result(world.rssi.size());
    for (Index i = 0; i < result.size(); ++i) result[i] = world.readings.tx[static_cast<std::size_t>(i)] == transmitter;
    return result;
  };
  Candidate pair;
  pair.id = "pair";
  pair.covariates = {"tx"};
  for (int from = 0; from < 4; ++from) {
    for (int to = 0; to < 4; ++to) {
      for (const double share : {-1.0, -0.5, 0.5, 1.0}) {
        if (from != to) pair.design.grid.push_back(Eigen::Vector3d(from, to, share));
      }
    }
  }
  pair.design.columns = [&](const Eigen::VectorXd& theta) -> Eigen::MatrixXd {
    return is_of(static_cast<int>(theta[0])) + theta[2] * is_of(static_cast<int>(theta[1]));
  };
  const Eigen::VectorXd effect = -9 * is_of(1) + 8 * is_of(2) + 6 * is_of(3);
  const Problem problem = problem_of(world, effect, {pair});
  ModelState state(problem, {});
  const Eigen::VectorXd& theta = pair.design.grid.front();
  const Candidate& lead = called(problem.candidates, "pair");
  const Eigen::MatrixXd columns = state.columns_of(lead, theta);
  Eigen::MatrixXd design(state.rows().size(), state.base().cols() + 1);
  design << state.base(), columns;
  EXPECT_EQ(bulk_inflation(state, state.whitened_model(design), lead, columns), 1);
}

}  // namespace
}  // namespace muster::inference
