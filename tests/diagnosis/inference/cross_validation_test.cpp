// Folds of cross-validation, and errors on them.
#include "diagnosis/inference/assess/cross_validation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/diagnosis/inference/synthetic.hpp"

namespace muster::inference {
namespace {

using synthetic::varied;
using synthetic::world_of;

struct Dealt {
  synthetic::World world = world_of(varied(15, 3000));
  noise::Rows rows = diagnosis::link_rows(world.readings);
  noise::Sites sites = diagnosis::link_sites(rows, world.readings);
  noise::Covariance c{noise::Family::exponential, world.true_theta};
  Folds folds{sites, blocks_of(sites, c), rows.row_of(), c, 1};
};

TEST(Folds, BlocksAreThreeDecorrelationDistancesWideAndCoverAllReadings) {
  const Dealt dealt;
  const auto& world = dealt.world;
  const auto& rows = dealt.rows;
  const Folds& folds = dealt.folds;
  const double side = 3 * dealt.c.decorrelation();
  EXPECT_LE(folds.blocks(), std::ceil(24 / side) * std::ceil(16 / side));
  EXPECT_GE(folds.blocks(), 8);
  // A mean within the design is predicted exactly; one outside is not.
  const Eigen::VectorXd exact = world.base * Eigen::Vector3d(-30, 2, 5);
  const auto errors = [&](const Eigen::MatrixXd& design) {
    return folds.squared_errors({rows.mean(exact), rows.mean(design)}, {exact, design});
  };
  EXPECT_LT(errors(world.base).maxCoeff(), 1e-12);
  const Eigen::VectorXd missing = errors(world.base.leftCols(2));
  EXPECT_EQ(missing.size(), world.readings.size());
  const HeldOutGain gain = folds.compared(missing, Eigen::VectorXd::Zero(missing.size()));
  EXPECT_NEAR(gain.gain, missing.mean(), 1e-9);
  EXPECT_LT(gain.lower95, gain.gain);
  EXPECT_GT(gain.upper95, gain.gain);
  EXPECT_GT(gain.lower95, 0);
}

// A receiver that reports nothing below -70 dBm says nothing of how far below a level is.
TEST(Folds, MissABoundByWhatItForbids) {
  const Dealt dealt;
  const auto& world = dealt.world;
  const auto& rows = dealt.rows;
  const Eigen::VectorXd level = world.base * Eigen::Vector3d(-30, 2, 5), clipped = level.cwiseMax(-70);
  noise::Bounds bounds{std::vector<noise::Known>(static_cast<std::size_t>(level.size()), noise::Known::value), 0.5};
  for (Index i = 0; i < level.size(); ++i) {
    if (level[i] <= -70) bounds.known[static_cast<std::size_t>(i)] = noise::Known::below;
  }
  ASSERT_TRUE(bounds.any());
  const Sample of_rows{rows.mean(level), rows.mean(world.base)};
  EXPECT_LT(dealt.folds.squared_errors(of_rows, {clipped, world.base, &bounds}).maxCoeff(), 1e-12);
  EXPECT_GT(dealt.folds.squared_errors(of_rows, {clipped, world.base}).maxCoeff(), 1);
}

}  // namespace
}  // namespace muster::inference
