// Rows of a model state that end at the edges of an obstacle.
#include "diagnosis/inference/state/model_state.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/diagnosis/inference/causes.hpp"

namespace muster::inference {
namespace {

using synthetic::causes_of;
using synthetic::problem_of;
using synthetic::varied;
using synthetic::world_of;

// Information on an object: rows of 2.5 m keep half of the single readings', and seven tenths once split at its
// edges.
TEST(ModelState, RowsThatEndAtAnObstaclesEdgesKeepMoreOfItsInformation) {
  const auto world = world_of(varied(12, 4000));
  const auto causes = causes_of(world);
  const Candidate& thing = causes.back();
  const Eigen::Vector3d at(11, 7, 0.7);
  const Eigen::VectorXd effect = -scaled_to(world, thing.design.columns(at), 60);
  const Problem long_rows = problem_of(world, effect, causes, {.time = 5, .way = 2.5}),
                single = problem_of(world, effect, causes, {.way = -1});
  ModelState state(long_rows, {}), readings(single, {});
  const auto told = [&](const ModelState& b) {
    const WhitenedModel model = b.whitened_model(b.design(), readings.fit.covariance);
    return model.at.basis.rest(model.whitener(b.columns_of(thing, at))).squaredNorm();
  };
  ASSERT_LT(3 * state.rows().size(), readings.rows().size());
  const double all = told(readings), before = told(state);
  const Index rows = state.rows().size(), more = state.end_rows_at(thing, at);
  EXPECT_GT(more, 5);
  EXPECT_EQ(state.rows().size(), rows + more);
  EXPECT_LT(before, 0.55 * all);
  EXPECT_GT(told(state), 0.68 * all);
  EXPECT_EQ(state.end_rows_at(thing, at), 0);
  for (const Entry& entry : state.entries()) EXPECT_EQ(entry.atoms->rows(), rows + more);
}

}  // namespace
}  // namespace muster::inference
