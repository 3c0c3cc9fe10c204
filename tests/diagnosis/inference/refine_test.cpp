// Refinement of a candidate: local search, successive halving and what it gains by chance.
#include "diagnosis/inference/score/refine.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "diagnosis/inference/score/refinement_null.hpp"
#include "tests/diagnosis/inference/causes.hpp"

namespace muster::inference {
namespace {

using synthetic::causes_of;
using synthetic::problem_of;
using synthetic::varied;
using synthetic::world_of;

TEST(LocalSearch, FindsTheOptimumInsideItsBoundsAndKeepsFixedEntries) {
  Candidate c;
  c.refinement.lower = Eigen::Vector3d(-5, 0, -5);
  c.refinement.upper = Eigen::Vector3d(5, 9, 2);
  c.refinement.step = Eigen::Vector3d(0.5, 0, 0.5);
  const auto [theta, value] = local_search(c, Eigen::Vector3d(3, 7, -3), 400, [](const Eigen::VectorXd& t) {
    return 10 - std::pow(t[0] - 1, 2) - std::pow(t[2] - 4, 2) - std::pow(t[1] - 2, 2);
  });
  EXPECT_NEAR(theta[0], 1, 0.05);
  EXPECT_EQ(theta[1], 7);
  EXPECT_NEAR(theta[2], 2, 0.02);
  EXPECT_NEAR(value, 10 - 25 - 4, 0.1);
}

TEST(LocalSearch, PassesOnExceptionsOfTheObjective) {
  Candidate c;
  c.refinement.lower = c.refinement.step = Eigen::VectorXd::Ones(1);
  c.refinement.upper = Eigen::VectorXd::Constant(1, 9);
  int calls = 0;
  const auto value = [&](const Eigen::VectorXd&) -> double {
    if (++calls > 3) throw std::runtime_error("no such place");
    return calls;
  };
  EXPECT_THROW(local_search(c, Eigen::VectorXd::Constant(1, 2), 50, value), std::runtime_error);
}

// Optima of heights 1, 2, 4 and 3 at 1, 3, 5 and 7, and the number of evaluations near each.
struct Tops {
  std::array<int, 4> looked = {};

  double operator()(const Eigen::VectorXd& theta) {
    constexpr std::array heights{1, 2, 4, 3};
    const auto nearest = static_cast<std::size_t>(std::clamp(std::lround((theta[0] - 1) / 2), 0l, 3l));
    ++looked[nearest];
    return heights[nearest] - std::abs(theta[0] - 1 - 2 * static_cast<double>(nearest));
  }
};

Candidate along_a_line() {
  Candidate c;
  c.refinement.lower = Eigen::VectorXd::Zero(1);
  c.refinement.upper = Eigen::VectorXd::Constant(1, 8);
  c.refinement.step = Eigen::VectorXd::Constant(1, 0.1);
  c.refinement.evaluations = 30;
  return c;
}

std::vector<Eigen::VectorXd> starting_at(const std::vector<double>& places) {
  std::vector<Eigen::VectorXd> result;
  result.reserve(places.size());
  for (const double place : places) result.push_back(Eigen::VectorXd::Constant(1, place));
  return result;
}

TEST(SuccessiveHalving, TheBetterHalfGetsTwiceTheEvaluations) {
  std::array<Tops, 3> laps;
  const Optimum top = successive_halving(along_a_line(), starting_at({1.1, 3.1, 5.1, 7.1}),
                                         {std::ref(laps[0]), std::ref(laps[1]), std::ref(laps[2])});
  EXPECT_EQ(laps[0].looked, (std::array{11, 11, 11, 11}));
  EXPECT_EQ(laps[1].looked, (std::array{0, 0, 21, 21}));
  EXPECT_EQ(laps[2].looked, (std::array{0, 0, 41, 0}));
  EXPECT_NEAR(top.first[0], 5, 0.05);
  EXPECT_NEAR(top.second, 4, 0.05);
}

TEST(SuccessiveHalving, MergesStartsThatMeet) {
  std::array<Tops, 2> laps;
  successive_halving(along_a_line(), starting_at({4.99, 5.01, 1, 3}), {std::ref(laps[0]), std::ref(laps[1])});
  EXPECT_EQ(laps[0].looked, (std::array{11, 11, 22, 0}));
  EXPECT_EQ(laps[1].looked, (std::array{0, 0, 21, 0}));
}

// A sketch may show an object where there is none: the final choice uses all readings.
TEST(Refined, KeepsTheOptimumThatTheSketchMisses) {
  const auto world = world_of(varied(12, 4000));
  std::vector<Candidate> causes = causes_of(world);
  Candidate& thing = causes.back();
  const Eigen::Vector3d at(11, 7, 0.7), elsewhere(20, 12, 0.7);
  const Problem plain = problem_of(world, -scaled_to(world, thing.design.columns(at), 100), causes);
  const noise::Rows rows = plain.layout->rows();
  const auto columns = thing.design.columns;
  thing.refinement.proposed = [&](Tally&) { return std::vector<Eigen::VectorXd>{at, elsewhere}; };
  thing.design.sketch = [&, columns](const Eigen::VectorXd& theta) {
    return rows.mean(columns(theta + at - elsewhere));
  };
  Problem problem = plain;
  problem.candidates = causes;
  ModelState state(problem, {});
  const WhitenedModel model = state.whitened_model(state.design());
  int leads = 0;
  for (const ScoredCandidate& lead : scored_candidates(state, model)) {
    if (lead.candidate().id != "obstacle") continue;
    ++leads;
    const ScoredCandidate best = refined(state, model, lead, false);
    EXPECT_GE(best.gain, model.gain(state.columns_of(lead.candidate(), at)) - 1e-9);
    EXPECT_LT((best.theta - at).head<2>().norm(), 0.5) << best.theta.transpose();
  }
  EXPECT_GT(leads, 0);
}

TEST(RefinementNull, IsAFewNatsForAWallAndLessForAStep) {
  const auto world = world_of(varied(16, 3000));
  const Problem problem = problem_of(world, Eigen::VectorXd::Zero(3000), causes_of(world));
  ModelState state(problem, {});
  const double wall = refinement_null(state, "unmapped_wall", 16), step = refinement_null(state, "step", 16);
  RecordProperty("wall", std::to_string(wall));
  RecordProperty("step", std::to_string(step));
  // Of 16 draws: the standard error near the lower quartile is sqrt(0.75 / (16 x 0.25)) = 0.43 nats.
  EXPECT_GT(wall, 0.3);
  EXPECT_LT(wall, 7);
  EXPECT_GT(step, -1.3);
  EXPECT_LT(step, 2.5);
  EXPECT_GT(wall, step + 1);
}

}  // namespace
}  // namespace muster::inference
