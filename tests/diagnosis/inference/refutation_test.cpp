// Terms that left-out readings refute, and those that they bear out.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "diagnosis/inference/assess/held_out_gain.hpp"
#include "tests/diagnosis/inference/causes.hpp"

namespace muster::inference {
namespace {

using synthetic::causes_of;
using synthetic::problem_of;
using synthetic::scaled_to;
using synthetic::varied;
using synthetic::world_of;

// A cause of this one column, under the name of its covariate.
Candidate of_column(const std::string& name, const Eigen::VectorXd& column) {
  Candidate result;
  result.id = name;
  result.covariates = {name};
  result.design.grid = {Eigen::VectorXd(0)};
  result.design.columns = [column](const Eigen::VectorXd&) { return Eigen::MatrixXd(column); };
  return result;
}

// Adds the last `count` of the candidates, which have no parameters, to the model.
void add_last(ModelState& state, const std::vector<Candidate>& candidates, std::size_t count, double gain) {
  for (std::size_t k = candidates.size() - count; k < candidates.size(); ++k) {
    const Entry& entry = state.entry_of(candidates[k]);
    state.terms.push_back(
        {entry.candidate, Eigen::VectorXd(0), state.columns_of(candidates[k], Eigen::VectorXd(0)), gain});
  }
  state.refit();
}

// True if a swing in the model is refuted, where the readings have a swing of this lambda: 0 for none.
bool swing_refuted(uint64_t seed, double lambda) {
  const auto world = world_of(varied(seed, 3000));
  const auto causes = causes_of(world);
  const Candidate& swing =
      *std::find_if(causes.begin(), causes.end(), [](const Candidate& c) { return c.id == "periodic"; });
  const Eigen::VectorXd& theta = swing.design.grid[swing.design.grid.size() / 3];
  const Eigen::VectorXd column = swing.design.columns(theta).col(0);
  Eigen::VectorXd effect = Eigen::VectorXd::Zero(column.size());
  if (lambda > 0) effect = scaled_to(world, column, lambda);
  const Problem problem = problem_of(world, effect, causes);
  ModelState state(problem, {});
  const Entry& entry = state.entry_of(swing);
  state.terms.push_back({entry.candidate, theta, state.columns_of(swing, theta)});
  state.refit();
  KeptFolds folds;
  return most_refuted(state, folds).has_value();
}

TEST(Refutation, BearsOutASwingThatIsThere) {
  for (uint64_t seed = 1; seed <= 8; ++seed) EXPECT_FALSE(swing_refuted(seed, 60)) << seed;
}

// A swing of no effect is as often a little better as worse, less the cost of its two coefficients.
TEST(Refutation, RefutesMostSwingsThatAreNotThere) {
  int refuted = 0;
  for (uint64_t seed = 1; seed <= 16; ++seed) refuted += swing_refuted(seed, 0);
  EXPECT_GE(refuted, 10);
}

// An offset of every other row is far smaller than the field, which raises or lowers levels by chance: in some worlds
// it worsens the plain error at left-out places. Neighbours tell that it is there.
TEST(Refutation, SparesASmallOffsetThatNeighboursShow) {
  for (uint64_t seed = 1; seed <= 12; ++seed) {
    const auto world = world_of(varied(seed, 3000));
    const auto causes = causes_of(world);
    const noise::Rows rows = problem_of(world, Eigen::VectorXd::Zero(world.rssi.size()), causes).layout->rows();
    Eigen::VectorXd column(world.rssi.size());
    for (Index i = 0; i < column.size(); ++i)
      column[i] = rows.row_of()[static_cast<std::size_t>(i)] % 2 == 0 ? 0.0 : 1.0;
    std::vector<Candidate> with = causes;
    with.push_back(of_column("offset", column));
    const Problem problem = problem_of(world, scaled_to(world, column, 60), with);
    ModelState state(problem, {});
    add_last(state, with, 1, 50);
    KeptFolds folds;
    EXPECT_FALSE(most_refuted(state, folds).has_value()) << seed;
  }
}

// What lies in one block but for a trace elsewhere, as a thing in a corner: without the block the trace alone says how
// large it is, and what it foretells is wild whether the thing is there or not.
TEST(Refutation, SparesWhatOneBlockAloneKnows) {
  for (uint64_t seed = 1; seed <= 6; ++seed) {
    const auto world = world_of(varied(seed, 3000));
    const auto causes = causes_of(world);
    const Problem bare = problem_of(world, Eigen::VectorXd::Zero(world.rssi.size()), causes);
    const ModelState before(bare, {});
    const std::vector<int> blocks = blocks_of(before.field().sites(), before.fit.covariance);
    Eigen::VectorXd column(world.rssi.size());
    for (Index i = 0; i < column.size(); ++i) {
      const Index row = before.rows().row_of()[static_cast<std::size_t>(i)];
      const bool inside = blocks[static_cast<std::size_t>(row)] == blocks[0];
      column[i] = inside ? 1 : row % 40 == 0 ? 0.003 : 0;
    }
    std::vector<Candidate> with = causes;
    with.push_back(of_column("corner", column));
    const Problem problem = problem_of(world, scaled_to(world, column, 300), with);
    ModelState state(problem, {});
    add_last(state, with, 1, 300);
    KeptFolds folds;
    EXPECT_FALSE(most_refuted(state, folds).has_value()) << seed;
  }
}

// Two causes that only the readings of one transmitter tell apart: places left out do not show it, that transmitter
// left out does.
TEST(Refutation, RefutesWhatOneGroupLeftOutMakesWild) {
  for (uint64_t seed = 1; seed <= 6; ++seed) {
    const auto world = world_of(varied(seed, 3000));
    std::vector<Candidate> with = causes_of(world);
    const Index n = world.rssi.size();
    Eigen::VectorXd one(n), other(n);
    for (Index i = 0; i < n; ++i) {
      const auto k = static_cast<std::size_t>(i);
      one[i] = world.readings.rx_at(0, i) - 12;
      other[i] = one[i] + (world.readings.tx[k] == 0 ? 3 : 0) + 0.002 * std::sin(static_cast<double>(i));
    }
    with.push_back(of_column("one", one));
    with.push_back(of_column("other", other));
    const Problem problem = problem_of(world, Eigen::VectorXd::Zero(n), with);
    ModelState state(problem, {});
    add_last(state, with, 2, 300);
    KeptFolds folds;
    EXPECT_TRUE(most_refuted(state, folds).has_value()) << seed;
  }
}

// What is kept of the last folds never shows in an error: with another covariance, other parts or other rows they are
// as if made anew.
TEST(Refutation, KeptFoldsAreThoseMadeAnew) {
  const auto world = world_of(varied(5, 3000));
  const auto causes = causes_of(world);
  const Problem problem = problem_of(world, Eigen::VectorXd::Zero(world.rssi.size()), causes);
  ModelState state(problem, {});
  KeptFolds kept;
  const auto blocks = [&] { return blocks_of(state.field().sites(), state.fit.covariance); };
  const auto expect_same = [&](const std::vector<int>& parts, const char* when) {
    const Sample rows{state.y(), state.base()}, readings{problem.measured, problem.base, &problem.bounds};
    const Folds anew(state.field().sites(), parts, state.rows().row_of(), state.fit.covariance, state.options().seed);
    Eigen::VectorXd errors = kept.of(state, parts).squared_errors(rows, readings);
    EXPECT_EQ((errors - anew.squared_errors(rows, readings)).cwiseAbs().maxCoeff(), 0) << when;
    return errors;
  };
  const std::vector<int> first = blocks();
  const Eigen::VectorXd before = expect_same(first, "first");
  expect_same(first, "again");
  state.fit.covariance.theta[1] += 0.5;
  EXPECT_NE(expect_same(first, "another covariance"), before);
  std::vector<int> halves(first.size());
  for (std::size_t i = 0; i < halves.size(); ++i) halves[i] = i < halves.size() / 2 ? 0 : 1;
  expect_same(halves, "other parts");
  const Candidate& step =
      *std::find_if(causes.begin(), causes.end(), [](const Candidate& c) { return c.id == "step"; });
  ASSERT_GT(state.end_rows_at(step, step.design.grid[step.design.grid.size() / 2]), 0);
  expect_same(blocks(), "rows split");
}

}  // namespace
}  // namespace muster::inference
