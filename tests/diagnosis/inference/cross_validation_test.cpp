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

TEST(Folds, BlocksAreThreeDecorrelationDistancesWideAndCoverAllReadings) {
  const auto world = world_of(varied(15, 3000));
  const noise::Rows rows = diagnosis::link_rows(world.readings);
  const noise::Sites sites = diagnosis::link_sites(rows, world.readings);
  const noise::Covariance c{noise::Family::exponential, world.true_theta};
  const Folds folds(sites, blocks_of(sites, c), rows.row_of(), c, 1);
  const double side = 3 * c.decorrelation();
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

}  // namespace
}  // namespace muster::inference
