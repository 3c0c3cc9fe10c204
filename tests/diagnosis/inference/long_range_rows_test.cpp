// Tests on longer rows: no excess of evidence, and only for effects that they resolve.
#include <gtest/gtest.h>

#include <algorithm>

#include "diagnosis/inference/assess/search.hpp"
#include "diagnosis/inference/state/null_tail.hpp"
#include "diagnosis/inference/thresholds.hpp"
#include "tests/diagnosis/inference/causes.hpp"

namespace muster::inference {
namespace {

using synthetic::causes_of;
using synthetic::problem_of;
using synthetic::varied;
using synthetic::world_of;

// Profile-likelihood gain with the noise refitted: repeating the same few rows does not double it.
TEST(LongRangeRows, LongerRowsDoNotInflateGains) {
  for (const uint64_t seed : {17u, 18u, 19u}) {
    const auto world = world_of(varied(seed, 4000));
    const auto causes = causes_of(world);
    const auto drift =
        std::find_if(causes.begin(), causes.end(), [](const Candidate& cause) { return cause.id == "drift"; });
    const Eigen::VectorXd& settling = drift->design.grid[0];
    const Eigen::VectorXd effect = scaled_to(world, drift->design.columns(settling), 100);
    const auto gains_by_row = [&](double share) {
      diagnosis::LinkRowLimits limits;
      limits.time *= share;
      limits.way *= share;
      const Problem problem = problem_of(world, effect, causes, limits);
      const ModelState state(problem, {});
      const noise::Covariance& noise = state.fit.covariance;
      return state.far().profile_gain({state.y(), state.design(), state.columns_of(*drift, settling), noise}, noise,
                                      state.likely_families(noise.family));
    };
    EXPECT_LT(gains_by_row(4), 1.2 * gains_by_row(1));
  }
}

// An offset of one transmitter in a smooth field under much noise. Excess evidence from few neighbours, or from its
// most favourable family, does not count.
TEST(LongRangeRows, PValueOfANameUsesTheExactCovariance) {
  const auto world = world_of({.seed = 3,
                               .readings = 2600,
                               .sigma = 2.25,
                               .decorrelation = 2.3,
                               .fading = 3.7,
                               .shape = synthetic::Shape::gaussian});
  Eigen::VectorXd effect(world.readings.size());
  for (Index i = 0; i < effect.size(); ++i) effect[i] = world.readings.tx[static_cast<std::size_t>(i)] == 0 ? 3.1 : 0;
  const Problem problem = problem_of(world, effect, causes_of(world));
  Search search(problem, {});
  const Result result = search.run();
  ASSERT_EQ(result.findings.size(), 1u);
  const ModelState& state = search.state();
  const Term& offset = state.terms[0];
  EXPECT_EQ(offset.id(), "tx_offset");
  const double near = state.whitened_model(state.base()).gain(offset.columns);
  const double sure = state.far().gain_lower_bound({state.y(), state.base(), offset.columns, state.fit.covariance});
  EXPECT_LT(sure, 0.9 * near);
  EXPECT_NEAR(result.trials[0].marginal_log_p,
              state.log_p(*offset.candidate, sure / thresholds::overdispersion, 1, true), 0.2);
}

// The threshold of a smooth is above that of a chi-square.
TEST(LongRangeRows, SmoothsNeedMoreThanTheChiSquareTail) {
  const auto world = world_of(varied(32, 3000));
  const Eigen::VectorXd effect = scaled_to(world, (3 * world.bearing().array() + 1).cos(), 80);
  const Problem problem = problem_of(world, effect, causes_of(world));
  Search search(problem, {});
  const Result result = search.run();
  const auto lobes = std::find_if(result.trials.begin(), result.trials.end(),
                                  [](const Trial& t) { return t.id == "~bearing" && t.accepted; });
  ASSERT_NE(lobes, result.trials.end());
  const ModelState& state = search.state();
  ASSERT_EQ(state.terms.size(), 1u);
  const Term& term = state.terms[0];
  EXPECT_GE(lobes->marginal_log_p, state.log_p(*term.candidate, lobes->gain / 1.1, term.columns.cols(), true) - 0.1);
}

// Longer rows average out an oscillation from row to row, but not an offset.
TEST(LongRangeRows, KeepOffsetsAndAverageOutFastChanges) {
  const auto world = world_of(varied(21, 3000));
  const Problem problem = problem_of(world, Eigen::VectorXd::Zero(3000), causes_of(world), {.way = 0.2});
  const ModelState state(problem, {});
  Eigen::MatrixXd offset(state.rows().size(), 1), swing = offset;
  const noise::Sites& sites = state.field().sites();
  for (Index i = 0; i < offset.rows(); ++i) {
    offset(i, 0) = sites.group[static_cast<std::size_t>(i)] == 0;
    swing(i, 0) = i % 2 ? 1 : -1;
  }
  const auto kept = [&](const Eigen::MatrixXd& columns) {
    return state.far().kept({state.y(), state.base(), columns, state.fit.covariance}, state.field());
  };
  EXPECT_GT(kept(offset), 0.6);
  EXPECT_LT(kept(swing), 0.3);
}

}  // namespace
}  // namespace muster::inference
