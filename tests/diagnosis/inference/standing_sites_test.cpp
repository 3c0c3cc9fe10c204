// The search where a network stands: few sites, each measured again and again.
#include <gtest/gtest.h>

#include <algorithm>

#include "diagnosis/inference/assess/search.hpp"
#include "muster/random.hpp"
#include "tests/diagnosis/inference/causes.hpp"

namespace muster::inference {
namespace {

using synthetic::problem_of;
using synthetic::varied;
using synthetic::World;
using synthetic::world_of;

// A network that stands: `sites` places with their transmitters, each measured again and again.
World standing_at(int sites) {
  const World driven = world_of(varied(37, 2000));
  World world = driven;
  for (Index i = 0; i < world.rssi.size(); ++i) {
    const Index site = i % sites, of = site * (world.rssi.size() / sites);
    const auto to = static_cast<std::size_t>(i), from = static_cast<std::size_t>(of);
    world.readings.tx[to] = driven.readings.tx[from];
    world.readings.rx[to] = driven.readings.rx[from];
    world.readings.rx_yaw[to] = 0;
    world.readings.tx_at.col(i) = driven.readings.tx_at.col(of);
    world.readings.rx_at.col(i) = driven.readings.rx_at.col(of);
    world.base.row(i) = driven.base.row(of);
    world.rssi[i] = world.base.row(i) * Eigen::Vector3d(-35, 2, 4) + Stream(37).normal(static_cast<uint64_t>(site)) +
                    world.recipe.fading * Stream(38).normal(static_cast<uint64_t>(i));
  }
  return world;
}

// A grid of waves in the plan, without a search between them.
Candidate waves_over(const World& world) {
  Candidate waves;
  waves.id = "waves";
  waves.covariates = {"waves"};
  waves.design.columns = [&world](const Eigen::VectorXd& theta) -> Eigen::MatrixXd {
    const auto x = world.readings.rx_at.row(0).array(), y = world.readings.rx_at.row(1).array();
    return (theta[0] * x + theta[1] * y + theta[2]).sin().matrix().transpose();
  };
  for (int y = 0; y < 10; ++y) {
    for (int x = 0; x < 15; ++x) waves.design.grid.push_back(Eigen::Vector3d(0.1 * x, 0.1 * y, 0.4));
  }
  return waves;
}

// A cause of four numbers fits whatever levels a few sites have; of many sites it says something.
TEST(StandingSites, ACauseOfMoreNumbersThanTheyLeaveIsNotNamed) {
  for (const int sites : {9, 60}) {
    const World world = standing_at(sites);
    Candidate waves = waves_over(world);
    waves.refinement.lower = Eigen::Vector3d::Zero();
    waves.refinement.upper = Eigen::Vector3d(1.5, 1, 3);
    waves.refinement.step = Eigen::Vector3d(0.05, 0.05, 0.1);
    Problem problem = problem_of(world, 12 * waves.design.columns(waves.design.grid[77]), {waves});
    problem.smooths.clear();
    const Result result = Search(problem).run();
    const auto named = std::count_if(result.findings.begin(), result.findings.end(),
                                     [](const Finding& f) { return f.id == "waves" && f.status == Status::named; });
    EXPECT_EQ(named, sites > 9 ? 1 : 0) << sites;
    const bool told = std::any_of(result.trials.begin(), result.trials.end(), [](const Trial& trial) {
      return trial.reason == "has more numbers than the sites of the network leave";
    });
    EXPECT_EQ(told, sites == 9) << sites;
  }
}

// Beside one of many waves few levels differ little, and the noise that is fitted there says that this is no chance.
TEST(StandingSites, FewLevelsAreHeldToAnFTest) {
  for (int sites = 7; sites <= 16; ++sites) {
    const World world = standing_at(sites);
    Problem problem = problem_of(world, Eigen::VectorXd::Zero(world.rssi.size()), {waves_over(world)});
    problem.smooths.clear();
    for (const Finding& f : Search(problem).run().findings) EXPECT_NE(f.status, Status::named) << sites << ": " << f.id;
  }
}

}  // namespace
}  // namespace muster::inference
