// What is left out together, and what a fit without it says of it.
#include "diagnosis/inference/assess/cross_validation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "tests/diagnosis/inference/synthetic.hpp"

namespace muster::inference {
namespace {

using synthetic::varied;
using synthetic::world_of;

TEST(Folds, BlocksAreThreeDecorrelationDistancesWideAndEveryReadingIsLeftOutOnce) {
  const auto world = world_of(varied(15, 3000));
  const noise::Rows rows(world.readings);
  const noise::Sites sites = rows.sites(world.readings);
  const noise::Covariance c{noise::Family::exponential, world.true_theta};
  const Folds folds(sites, blocks_of(sites, c), rows.row_of(), c, 1);
  const double side = 3 * c.decorrelation();
  EXPECT_LE(folds.blocks(), std::ceil(24 / side) * std::ceil(16 / side));
  EXPECT_GE(folds.blocks(), 8);
  // A mean that the design holds is predicted to the last bit; one that it lacks is not.
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

TEST(Folds, LeaveRadiosOutThatDiffer) {
  const auto world = world_of(varied(15, 3000));
  const noise::Rows rows(world.readings);
  const noise::Sites sites = rows.sites(world.readings);
  const std::vector<int> radios = radios_of(rows, sites, world.readings);
  const std::set<int> different(radios.begin(), radios.end());
  ASSERT_GE(different.size(), 2u);
  EXPECT_EQ(*different.rbegin() + 1, static_cast<int>(different.size()));
  // Where one station alone stands, what moves is left out.
  diagnosis::LinkReadings one = world.readings;
  const int robot = *std::max_element(one.rx.begin(), one.rx.end()) + 1;
  for (std::size_t i = 0; i < one.tx.size(); ++i) {
    one.rx[i] = robot + one.tx[i];
    one.tx[i] = 0;
    one.tx_at.col(static_cast<Index>(i)) = one.tx_at.col(0);
  }
  const noise::Rows of_one(one);
  const std::vector<int> robots = radios_of(of_one, of_one.sites(one), one);
  for (Index i = 0; i < of_one.size(); ++i) {
    const auto example = static_cast<std::size_t>(of_one.example(i));
    EXPECT_EQ(robots[static_cast<std::size_t>(i)] == robots[0],
              one.rx[example] == one.rx[static_cast<std::size_t>(of_one.example(0))]);
  }
}

}  // namespace
}  // namespace muster::inference
