// Errors over time: against dense covariances, and chosen where each link of a standing network wanders by itself.
#include "diagnosis/inference/noise/over_time.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "diagnosis/inference/noise/exact_covariance.hpp"
#include "diagnosis/inference/state/model_state.hpp"
#include "muster/random.hpp"

namespace muster::inference {
namespace {

using noise::Covariance;
using noise::Family;
using noise::Sites;

constexpr double step = 600, memory = 9000;  // s

// Links that stand about three anchors, each read in every step.
Sites standing(Index links, Index moments) {
  const Index n = links * moments;
  const Eigen::Matrix3Xd nowhere = Eigen::Matrix3Xd::Zero(3, n);
  Sites sites{nowhere, nowhere, nowhere, nowhere, {}, Eigen::VectorXd::Ones(n)};
  for (Index i = 0; i < n; ++i) {
    const Index link = i % links, lane = link / 7;
    sites.place.col(i) << 5.0 * static_cast<double>(link % 7), 4.0 * static_cast<double>(lane), 0;
    sites.anchor.col(i) << 6.0 * static_cast<double>(link % 3), 9, 0;
    sites.group.push_back(static_cast<int>(link % 3));
  }
  return sites;
}

std::vector<double> times_of(const Sites& sites, Index links) {
  std::vector<double> result;
  for (Index i = 0; i < sites.size(); ++i) {
    const Index moment = i / links;
    result.push_back(1.7e9 + step * static_cast<double>(moment));
  }
  return result;
}

// Levels of links 3 dB apart, readings 0.7 dB; each link wanders by `wander` dB.
Eigen::VectorXd drawn(Index links, Index n, double wander, uint64_t seed) {
  const Stream level(combined(key_of("levels"), seed)), reading(combined(key_of("readings"), seed)),
      walk(combined(key_of("wander"), seed));
  const double kept = std::exp(-step / memory);
  Eigen::VectorXd result(n), at(links);
  for (Index i = 0; i < n; ++i) {
    const auto k = static_cast<uint64_t>(i);
    const Index link = i % links;
    at[link] = i < links ? walk.normal(k) : kept * at[link] + std::sqrt(1 - kept * kept) * walk.normal(k);
    result[i] = 3 * level.normal(static_cast<uint64_t>(link)) + wander * at[link] + 0.7 * reading.normal(k);
  }
  return result;
}

class Network : public Layout {
 public:
  Network(Index links, Index moments) : links_(links), sites_(standing(links, moments)) {}
  Index size() const override { return sites_.size(); }
  noise::Rows rows() const override {
    std::vector<Index> order;
    for (Index i = 0; i <= size(); ++i) order.push_back(i);
    std::vector<Index> first = order;
    order.pop_back();
    return {std::move(order), std::move(first)};
  }
  Sites sites(const noise::Rows& /*rows*/) const override { return sites_; }
  std::vector<double> times(const noise::Rows& /*rows*/) const override { return times_of(sites_, links_); }

 private:
  Index links_;
  Sites sites_;
};

Problem problem_of(Index links, Index moments, double wander, uint64_t seed) {
  Problem problem;
  problem.layout = std::make_shared<const Network>(links, moments);
  problem.measured = drawn(links, links * moments, wander, seed);
  problem.base = Eigen::MatrixXd::Ones(links * moments, 1);
  return problem;
}

TEST(OverTime, LikelihoodIsTheDenseOne) {
  constexpr Index links = 6, moments = 14, n = links * moments;
  const Sites places = standing(links, moments);
  const Sites sites = noise::over_time(places, times_of(places, links), memory);
  const noise::Field field(sites, {n, n, 1});
  const Covariance c{noise::with_fixed(Family::exponential, 3, 0),
                     {std::log(16.0), std::log(1.7), std::log(2.0), -1.2}};
  const double fixed = noise::fixed_share(c.family);
  Eigen::MatrixXd dense(n, n);
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < n; ++j) {
      const Index steps = i / links - j / links;
      const double apart = step / memory * std::abs(static_cast<double>(steps));
      const bool same = i % links == j % links;
      dense(i, j) =
          c.field_variance() * ((same ? fixed : 0) + (1 - fixed) * (same ? 1 : c.shared()) *
                                                         noise::correlation(c.family, apart / c.decorrelation()));
    }
    dense(i, i) += c.reading_variance() + 1e-3;
  }
  const Eigen::LLT<Eigen::MatrixXd> root(dense);
  const noise::Whitener whitener(field, c);
  EXPECT_NEAR(-whitener.log_scale(), root.matrixLLT().diagonal().array().log().sum(), 0.05);
  const Eigen::VectorXd y = drawn(links, n, 1.5, 3);
  EXPECT_NEAR(whitener(y).squaredNorm() / y.dot(root.solve(y)), 1, 4e-3);
  const Eigen::MatrixXd weights = Eigen::MatrixXd::Random(n, 3), expected = weights.transpose() * dense * weights;
  EXPECT_LT((noise::covariance_of_sums(field, c, weights) - expected).norm(), 1e-3 * expected.norm());
}

TEST(OverTime, IsChosenWhereEachSiteWanders) {
  for (uint64_t seed = 1; seed <= 4; ++seed) {
    const Problem problem = problem_of(20, 60, 1.5, seed);
    const ModelState state(problem, {});
    ASSERT_GT(state.time_unit(), 0) << seed;
    const Covariance& c = state.fit.covariance;
    const double fixed = noise::fixed_share(c.family);
    EXPECT_NEAR(std::log(c.decorrelation() * state.time_unit() * noise::efold(c.family) / memory), 0, 0.7) << seed;
    EXPECT_NEAR(std::sqrt((1 - fixed) * c.field_variance()), 1.5, 0.5) << seed;
    EXPECT_NEAR(std::sqrt(c.reading_variance()), 0.7, 0.15) << seed;
  }
}

TEST(OverTime, IsNotChosenWhereLinksStandStill) {
  for (uint64_t seed = 1; seed <= 4; ++seed) {
    const Problem still = problem_of(20, 60, 0, seed), few = problem_of(200, 6, 1.5, seed);
    EXPECT_EQ(ModelState(still, {}).time_unit(), 0) << seed;
    EXPECT_EQ(ModelState(few, {}).time_unit(), 0) << seed << ": too few moments of each";
  }
}

// One jump is no wander: with a step among the candidates, steady levels that jump keep the noise over places.
TEST(OverTime, IsNotChosenForAStepAlone) {
  Problem problem = problem_of(20, 60, 0, 9);
  Candidate step;
  step.id = "step";
  step.covariates = {"time"};
  step.role.time_like = true;
  step.design.columns = [](const Eigen::VectorXd& theta) -> Eigen::MatrixXd {
    Eigen::MatrixXd column = Eigen::MatrixXd::Zero(1200, 1);
    for (Index i = 0; i < 1200; ++i) {
      const Index moment = i / 20;
      column(i, 0) = i % 20 == 4 && static_cast<double>(moment) >= theta[0];
    }
    return column;
  };
  for (int k = 5; k < 60; k += 5) step.design.grid.push_back(Eigen::VectorXd::Constant(1, k));
  for (Index k = 40; k < 60; ++k) problem.measured[20 * k + 4] += 20;
  EXPECT_GT(ModelState(problem, {}).time_unit(), 0);
  problem.candidates.push_back(step);
  EXPECT_EQ(ModelState(problem, {}).time_unit(), 0);
}

// A step of all links of one anchor, as of its power, keeps its evidence; a slow rise that a few links happen to share
// loses what the noise over places would give it.
TEST(OverTime, LeavesAStepItsEvidenceAndTakesItFromWander) {
  const Problem problem = problem_of(20, 60, 1.5, 7);
  const ModelState over_time(problem, {});
  ASSERT_GT(over_time.time_unit(), 0);
  const noise::Field places(standing(20, 60));
  const Eigen::MatrixXd base = Eigen::MatrixXd::Ones(1200, 1);
  const noise::Fit fit = noise::fit_families(places, problem.measured, base, {}).front();
  const noise::Whitener by_place(places, fit.covariance);
  double wander = 0, wander_by_place = 0;
  for (Index link = 0; link < 20; ++link) {
    Eigen::VectorXd rise = Eigen::VectorXd::Zero(1200);
    for (Index k = 0; k < 60; ++k) rise[20 * k + link] = static_cast<double>(k) / 60;
    wander = std::max(wander, over_time.whitened_model(base).gain(rise));
    const noise::Whitened at = noise::whitened(by_place, problem.measured, base, {});
    const Eigen::VectorXd left = at.basis.rest(by_place(rise));
    wander_by_place = std::max(wander_by_place, std::pow(left.normalized().dot(at.residual), 2));
  }
  EXPECT_LT(wander, 20);
  EXPECT_GT(wander_by_place, 40);
  Eigen::VectorXd change = Eigen::VectorXd::Zero(1200);
  for (Index i = 0; i < 1200; ++i) change[i] = i % 20 % 3 == 1 && i / 20 >= 33 ? 3 : 0;
  const Problem stepped = [&] {
    Problem with = problem;
    with.measured += change;
    return with;
  }();
  const ModelState state(stepped, {});
  EXPECT_GT(state.whitened_model(base).gain(change), 40);
}

}  // namespace
}  // namespace muster::inference
