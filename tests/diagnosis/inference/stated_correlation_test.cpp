// A correlation that a model states: like a family of its own in likelihood, derivatives, exact sums and fits.
#include "diagnosis/inference/noise/stated_correlation.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>

#include "diagnosis/inference/noise/exact_covariance.hpp"
#include "diagnosis/inference/noise/fit.hpp"
#include "muster/random.hpp"

namespace muster::noise {
namespace {

// Falls with the distance of both ends, and is the stronger the longer a link is: no function of one distance.
class OfBothEnds : public StatedCorrelation {
 public:
  static double at(const Sites& sites, double decorrelation, Index a, Index b) {
    const auto size = [&](Index i) {
      const double length = (sites.place.col(i) - sites.anchor.col(i)).norm();
      return std::sqrt(-std::expm1(-length / decorrelation));
    };
    const double apart =
        (sites.place.col(a) - sites.place.col(b)).norm() + (sites.anchor.col(a) - sites.anchor.col(b)).norm();
    return size(a) * size(b) * std::exp(-apart / decorrelation);
  }
  void covariances(const Sites& sites, double decorrelation, const std::vector<uint32_t>& a,
                   const std::vector<uint32_t>& b, double* out) const override {
    for (std::size_t i = 0; i < a.size(); ++i)
      out[i] = at(sites, decorrelation, static_cast<Index>(a[i]), static_cast<Index>(b[i]));
  }
};

Sites sites_of(Index n, uint64_t seed) {
  const Stream s(seed);
  Sites sites{Eigen::Matrix3Xd::Zero(3, n),
              Eigen::Matrix3Xd::Zero(3, n),
              Eigen::Matrix3Xd::Zero(3, n),
              Eigen::Matrix3Xd::Zero(3, n),
              {},
              Eigen::VectorXd(n),
              std::make_shared<OfBothEnds>()};
  for (Index i = 0; i < n; ++i) {
    const auto k = static_cast<uint64_t>(i);
    sites.place.col(i) << 6 * s.uniform(k, 0), 5 * s.uniform(k, 1), s.uniform(k, 2);
    sites.group.push_back(static_cast<int>(k % 3));
    sites.anchor.col(i) << 3.0 * static_cast<double>(k % 3), 1, 0;
    sites.count[i] = 1 + std::floor(3 * s.uniform(k, 3));
  }
  return sites;
}

Covariance with(double log_decorrelation) {
  return {Family::stated, {std::log(9.0), log_decorrelation, std::log(1.0), -1.2}};
}

Eigen::MatrixXd dense(const Sites& sites, const Covariance& c) {
  Eigen::MatrixXd result(sites.size(), sites.size());
  for (Index i = 0; i < sites.size(); ++i) {
    for (Index j = 0; j < sites.size(); ++j)
      result(i, j) = c.field_variance() * OfBothEnds::at(sites, c.decorrelation(), i, j);
    result(i, i) += c.reading_variance() / sites.count[i] + 1e-3;
  }
  return result;
}

Eigen::VectorXd normals(Index n, uint64_t draw) {
  Eigen::VectorXd z(n);
  for (Index i = 0; i < n; ++i) z[i] = Stream(9).normal(static_cast<uint64_t>(i), draw);
  return z;
}

TEST(StatedCorrelation, GivesTheDenseLikelihood) {
  const Sites sites = sites_of(60, 5);
  const Field field(sites, {60, 60, 1});
  // On a tabulated distance, and between two.
  for (const double log_decorrelation : {0.5, 0.61}) {
    const Covariance c = with(log_decorrelation);
    const Whitener whitener(field, c);
    const Eigen::LLT<Eigen::MatrixXd> root(dense(sites, c));
    EXPECT_NEAR(-whitener.log_scale(), root.matrixLLT().diagonal().array().log().sum(), 0.1);
    const Eigen::VectorXd y = root.matrixL() * normals(60, 0);
    EXPECT_NEAR(whitener(y).squaredNorm() / y.dot(root.solve(y)), 1, 0.02);
  }
}

// Within 1e-3 of one that falls with the places' distance, as sums and tables come.
class Inexact : public StatedCorrelation {
 public:
  void covariances(const Sites& sites, double decorrelation, const std::vector<uint32_t>& a,
                   const std::vector<uint32_t>& b, double* out) const override {
    for (std::size_t i = 0; i < a.size(); ++i) {
      const auto one = static_cast<Index>(a[i]), other = static_cast<Index>(b[i]);
      const double apart = (sites.place.col(one) - sites.place.col(other)).norm() / decorrelation;
      out[i] = std::exp(-apart * apart) - (a[i] == b[i] ? 0 : 1e-3 * Stream(4).uniform(a[i] + b[i], a[i] * b[i]));
    }
  }
};

TEST(StatedCorrelation, MayBeWrongByMoreThanTheReadingsScatter) {
  Sites sites = sites_of(200, 5);
  sites.stated = std::make_shared<Inexact>();
  const Covariance c{Family::stated, {std::log(80.0), std::log(6.0), std::log(0.05), 0}};
  const Field field(sites, {20, 0, 1});
  const Whitener whitener(field, c);
  // What neighbours cannot predict, a reading's variance over the count and the floor of 1e-3, is a bound.
  const double most = 1 / std::sqrt(0.05 / 3 + 1e-3);
  for (const double own : whitener.stencil().own) EXPECT_LE(own, most * (1 + 1e-9));
  EXPECT_TRUE(whitener(normals(200, 3)).allFinite());
  EXPECT_TRUE(WhitenerSlopes(field, c).of_log_scale().allFinite());
}

TEST(StatedCorrelation, DerivativesAreThoseOfTheLikelihood) {
  const Field field(sites_of(120, 8));
  const Eigen::VectorXd y = 3 * normals(120, 1);
  const Eigen::MatrixXd design = Eigen::MatrixXd::Ones(120, 1);
  const Prior prior;
  const Covariance c = with(0.61);
  const Objective here = objective(field, c, y, design, prior);
  for (Index p = 0; p < 4; ++p) {
    const auto value = [&](double by) {
      Covariance moved = c;
      moved.theta[p] += by;
      return objective(field, moved, y, design, prior).value;
    };
    EXPECT_NEAR(here.gradient[p], (value(1e-4) - value(-1e-4)) / 2e-4, 1e-4 * (1 + std::abs(here.gradient[p]))) << p;
  }
}

TEST(StatedCorrelation, ExactCovarianceOfSumsIsTheDenseOne) {
  const Sites sites = sites_of(83, 6);
  const Eigen::MatrixXd weights = Eigen::MatrixXd::Random(83, 3);
  const Eigen::MatrixXd expected = weights.transpose() * dense(sites, with(0.75)) * weights;
  EXPECT_LT((covariance_of_sums(Field(sites), with(0.75), weights) - expected).norm(), 2e-3 * expected.norm());
}

TEST(StatedCorrelation, IsChosenForItsOwnDrawsAndItsDistanceFound) {
  const Sites sites = sites_of(700, 11);
  const Field field(sites);
  const Eigen::MatrixXd root = Eigen::LLT<Eigen::MatrixXd>(dense(sites, with(0.5))).matrixL();
  double log_distance = 0, log_variance = 0;
  constexpr uint64_t worlds = 6;
  for (uint64_t world = 0; world < worlds; ++world) {
    const std::vector<Fit> fits =
        fit_families(field, root * normals(700, world), Eigen::MatrixXd::Ones(700, 1), Prior{});
    EXPECT_EQ(fits[0].covariance.family, Family::stated) << world;
    log_distance += fits[0].covariance.theta[1] / worlds;
    log_variance += fits[0].covariance.theta[0] / worlds;
  }
  EXPECT_NEAR(log_distance, 0.5, 0.2);
  EXPECT_NEAR(log_variance, std::log(9.0), 0.25);
}

// It may have to be integrated for, and a pair of rows stands in many neighbourhoods.
TEST(StatedCorrelation, IsAskedForEachPairOnce) {
  class Asked : public OfBothEnds {
   public:
    void covariances(const Sites& sites, double decorrelation, const std::vector<uint32_t>& a,
                     const std::vector<uint32_t>& b, double* out) const override {
      for (std::size_t i = 0; i < a.size(); ++i) ++times[std::minmax({a[i], b[i]})];
      OfBothEnds::covariances(sites, decorrelation, a, b, out);
    }
    mutable std::map<std::pair<uint32_t, uint32_t>, int> times;
  };
  Sites sites = sites_of(200, 7);
  const auto asked = std::make_shared<Asked>();
  sites.stated = asked;
  const Field field(sites);
  field.stated(1);
  EXPECT_GT(asked->times.size(), 1000u);
  for (const auto& [pair, times] : asked->times) EXPECT_EQ(times, 1) << pair.first << ' ' << pair.second;
}

TEST(StatedCorrelation, IsNoFamilyWhereNoneIsStated) {
  Sites sites = sites_of(50, 5);
  EXPECT_EQ(Field(sites).families().front(), Family::stated);
  sites.stated = nullptr;
  EXPECT_EQ(Field(sites).families(), std::vector<Family>(families.begin(), families.end()));
}

}  // namespace
}  // namespace muster::noise
