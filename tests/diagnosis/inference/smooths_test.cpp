// Which smooths are looked along, and of what shapes.
#include "diagnosis/inference/state/smooths.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/diagnosis/inference/causes.hpp"

namespace muster::inference {
namespace {

using synthetic::problem_of;
using synthetic::varied;
using synthetic::world_of;

TEST(Smooths, CoverEveryColumnFactorAndProduct) {
  const auto world = world_of(varied(4, 400));
  Problem problem = problem_of(world, Eigen::VectorXd::Zero(400), {});
  problem.factors.push_back({"phone", std::vector<int>(400, 0)});
  for (std::size_t i = 0; i < 400; i += 3) problem.factors[0].level[i] = 1;
  std::set<std::string> ids;
  for (const Candidate& c : smooths_of(problem)) {
    ids.insert(c.id);
    const Eigen::MatrixXd columns = c.columns(c.grid.front());
    EXPECT_EQ(columns.rows(), 400) << c.id;
    EXPECT_EQ(columns.cols(), c.width) << c.id;
    EXPECT_TRUE(columns.allFinite()) << c.id;
    EXPECT_GT((columns.rowwise() - columns.colwise().mean()).norm(), 1e-3) << c.id;
    if (c.wider) {
      EXPECT_EQ(c.wider(2).cols(), 2 * c.width) << c.id;
    }
  }
  for (const char* id : {"~logd", "~bearing", "~heading", "~txbearing", "~position", "~time", "~time_per_tx",
                         "~time*position", "~link", "~phone", "~speed", "~battery", "~temperature", "~temperature*logd",
                         "~speed*position", "slope~position", "chirp~time", "bend~battery"})
    EXPECT_EQ(ids.count(id), 1u) << id;
}

// What depends on where a robot is, and on which way it looks, does so when it sends as when it hears.
// Time passes whatever happens: what was observed comes before a function of it that does as well.
TEST(Smooths, OfTimeGiveWayToColumns) {
  const auto world = world_of(varied(4, 400));
  const Problem problem = problem_of(world, Eigen::VectorXd::Zero(400), {});
  for (const Candidate& c : smooths_of(problem))
    EXPECT_EQ(c.time_like, c.id == "~time" || c.id == "chirp~time") << c.id;
}

TEST(Smooths, AreTheSameForBothDirectionsOfALink) {
  const auto world = world_of(varied(6, 300));
  const Problem heard = problem_of(world, Eigen::VectorXd::Zero(300), {});
  Problem sent = heard;
  std::swap(sent.readings.tx, sent.readings.rx);
  std::swap(sent.readings.tx_at, sent.readings.rx_at);
  std::swap(sent.readings.tx_yaw, sent.readings.rx_yaw);
  sent.readings.rx_yaw.assign(300, 0.3);  // stations look somewhere too
  const auto columns = [](const Problem& problem, const std::string& id) {
    const std::vector<Candidate> all = smooths_of(problem);
    const auto found = std::find_if(all.begin(), all.end(), [&](const Candidate& c) { return c.id == id; });
    return found == all.end() ? Eigen::MatrixXd() : found->columns(found->grid.front());
  };
  for (const char* id : {"~bearing", "~heading", "~position", "slope~position", "~speed*position", "~logd"}) {
    const Eigen::MatrixXd one = columns(heard, id), other = columns(sent, id);
    ASSERT_EQ(one.rows(), other.rows()) << id;
    ASSERT_GT(one.cols(), 0) << id;
    EXPECT_LT((one - other).cwiseAbs().maxCoeff(), 1e-12) << id;
  }
}

TEST(Smooths, ABendIsFlatOnOneSide) {
  const auto world = world_of(varied(7, 300));
  const Problem problem = problem_of(world, Eigen::VectorXd::Zero(300), {});
  for (const Candidate& c : smooths_of(problem)) {
    if (c.id != "bend~battery") continue;
    for (const Eigen::VectorXd& theta : c.grid) {
      const Eigen::VectorXd column = c.columns(theta);
      for (Index i = 0; i < column.size(); ++i) {
        const double beyond = theta[1] * (world.battery[i] - theta[0]);
        EXPECT_NEAR(column[i], std::max(beyond, 0.0), 1e-12) << theta.transpose();
      }
      EXPECT_GT((column.array() > 0).count(), 25) << theta.transpose();
    }
  }
}

TEST(Smooths, NothingDependsOnPlacesThatAreNotKnown) {
  const auto world = world_of(varied(4, 400));
  Problem problem = problem_of(world, Eigen::VectorXd::Zero(400), {});
  problem.places_known = false;
  for (const Candidate& c : smooths_of(problem)) {
    for (const std::string& covariate : c.covariates)
      EXPECT_TRUE(covariate.find("position") == std::string::npos && covariate.find("bearing") == std::string::npos)
          << c.id;
  }
}

}  // namespace
}  // namespace muster::inference
