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

// A world of some 24 m, and the same 2.4 km wide with a field that is as much longer: causes and effects are alike.
struct Worlds {
  World near, far;

  explicit Worlds(uint64_t seed) : near(world_of(varied(seed, 1500))), far(near) {
    far.readings.tx_at *= scale;
    far.readings.rx_at *= scale;
  }
};

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

// With room for short fields alone nearly every such world gets a name.
TEST(SelectionOverRanges, FindsLessInALongFieldAlone) {
  int with_long_fields = 0, with_short_fields = 0;
  for (uint64_t seed = 1; seed <= 4; ++seed) {
    const Worlds worlds(seed);
    const Problem problem =
        problem_of(worlds.far, Eigen::VectorXd::Zero(worlds.far.rssi.size()), causes_of(worlds.near));
    const auto state = selected(problem, 2900);
    with_long_fields += state->terms.empty() ? 0 : 1;
    EXPECT_GT(state->fit.covariance.decorrelation(), 40) << seed;
    with_short_fields += selected(problem, 0)->terms.empty() ? 0 : 1;
  }
  EXPECT_LE(with_long_fields, 1);
  EXPECT_GE(with_short_fields, 3);
}

TEST(SelectionOverRanges, FindsAStepInAFieldOfTwoHundredMetres) {
  int found = 0;
  for (uint64_t seed = 11; seed <= 12; ++seed) {
    const Worlds worlds(seed);
    const auto causes = causes_of(worlds.near);
    const Candidate& step =
        *std::find_if(causes.begin(), causes.end(), [](const Candidate& c) { return c.id == "step"; });
    const Eigen::VectorXd column = step.design.columns(step.design.grid[step.design.grid.size() / 2]).col(0);
    const Problem problem = problem_of(worlds.far, scaled_to(worlds.near, column, 150), causes);
    const auto state = selected(problem, 2900);
    found += std::any_of(state->terms.begin(), state->terms.end(), [](const Term& t) { return t.id() == "step"; });
  }
  EXPECT_EQ(found, 2);
}

}  // namespace
}  // namespace muster::inference
