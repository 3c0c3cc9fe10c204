// Selection where places reach far: a field may be as long as they are apart in proportion.
#include "diagnosis/inference/select/selection_over_ranges.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/diagnosis/inference/causes.hpp"

namespace muster::inference {
namespace {

using synthetic::causes_of;
using synthetic::problem_of;
using synthetic::scaled_to;
using synthetic::varied;
using synthetic::World;
using synthetic::world_of;

constexpr double scale = 100;

// A plan of 2.4 km, with a field that is as much longer.
World wide_world(uint64_t seed) {
  World world = world_of(varied(seed, 1500));
  world.readings.tx_at *= scale;
  world.readings.rx_at *= scale;
  for (synthetic::Segment& wall : world.walls) {
    for (double& x : wall) x *= scale;
  }
  world.recipe.width *= scale, world.recipe.height *= scale;
  return world;
}

std::unique_ptr<ModelState> selected(const Problem& problem, double reach) {
  Options options;
  options.prior = options.prior.widened(reach);
  auto state = std::make_unique<ModelState>(problem, options);
  std::vector<Trial> trials;
  selection_over_ranges(state, trials);
  return state;
}

TEST(Prior, IsTheUsualOneUpToItsReachAndHasRoomInProportionBeyond) {
  const noise::Prior usual;
  for (const double reach : {0.0, 20.0, 60.0}) {
    EXPECT_FALSE(usual.widened(reach).is_wider());
    EXPECT_EQ(usual.widened(reach).upper(), usual.upper());
  }
  const noise::Prior wide = usual.widened(600), again = wide.widened(6000);
  EXPECT_TRUE(wide.is_wider());
  EXPECT_NEAR(wide.upper()[1] - usual.upper()[1], std::log(10), 1e-12);
  EXPECT_NEAR(again.upper()[1] - usual.upper()[1], std::log(100), 1e-12);
  EXPECT_NEAR(wide.lower()[1], usual.lower()[1], 1e-12);
  EXPECT_NEAR(wide.log_decorrelation - wide.decorrelation_spread, usual.log_decorrelation - usual.decorrelation_spread,
              1e-12);
  EXPECT_NEAR(wide.narrowed().log_decorrelation, usual.log_decorrelation, 1e-12);
  EXPECT_NEAR(wide.narrowed().decorrelation_spread, usual.decorrelation_spread, 1e-12);
  EXPECT_FALSE(wide.narrowed().is_wider());
}

TEST(SelectionOverRanges, FindsNothingInALongFieldAlone) {
  int with_short_fields = 0;
  for (uint64_t seed = 1; seed <= 6; ++seed) {
    const World world = wide_world(seed);
    const Problem problem = problem_of(world, Eigen::VectorXd::Zero(world.rssi.size()), causes_of(world));
    const auto state = selected(problem, 2900);
    EXPECT_EQ(state->terms.size(), 0u) << seed << ' ' << (state->terms.empty() ? "" : state->terms[0].id());
    EXPECT_GT(state->fit.covariance.decorrelation(), 40) << seed;
    with_short_fields += selected(problem, 0)->terms.empty() ? 0 : 1;
  }
  EXPECT_GT(with_short_fields, 0);  // such fields do need the room
}

TEST(SelectionOverRanges, FindsAStepInAFieldOfTwoHundredMetres) {
  int found = 0;
  for (uint64_t seed = 11; seed <= 14; ++seed) {
    const World world = wide_world(seed);
    const auto causes = causes_of(world);
    const Candidate& step =
        *std::find_if(causes.begin(), causes.end(), [](const Candidate& c) { return c.id == "step"; });
    const Eigen::VectorXd column = step.design.columns(step.design.grid[step.design.grid.size() / 2]).col(0);
    const auto state = selected(problem_of(world, scaled_to(world, column, 150), causes), 2900);
    found += std::any_of(state->terms.begin(), state->terms.end(), [](const Term& t) { return t.id() == "step"; });
  }
  EXPECT_GE(found, 3);
}

}  // namespace
}  // namespace muster::inference
