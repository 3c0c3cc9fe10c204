// The noise model against closed forms: dense covariances, finite differences, known draws.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "diagnosis/inference/noise/censored.hpp"
#include "diagnosis/inference/noise/exact_covariance.hpp"
#include "diagnosis/inference/noise/fit.hpp"
#include "diagnosis/inference/noise/whitener_columns.hpp"
#include "muster/random.hpp"
#include "tests/diagnosis/inference/apart.hpp"
#include "tests/diagnosis/inference/synthetic.hpp"

namespace muster::noise {
namespace {

Sites scattered(Index n, int radios, uint64_t seed) {
  const Stream s(seed);
  Sites sites{Eigen::Matrix3Xd::Zero(3, n),
              Eigen::Matrix3Xd::Zero(3, n),
              Eigen::Matrix3Xd::Zero(3, n),
              Eigen::Matrix3Xd::Zero(3, n),
              {},
              Eigen::VectorXd(n)};
  for (Index i = 0; i < n; ++i) {
    const auto k = static_cast<uint64_t>(i);
    sites.place.col(i) << 6 * s.uniform(k, 0), 5 * s.uniform(k, 1), s.uniform(k, 2);
    const int radio = static_cast<int>(k) % radios;
    sites.group.push_back(radio);
    sites.anchor.col(i) << 3.0 * radio, 1, 0;
    sites.count[i] = 1 + std::floor(3 * s.uniform(k, 3));
    if (sites.count[i] > 1) sites.place_stretch.col(i) << 0.3 * s.uniform(k, 4), 0.3 * s.uniform(k, 5), 0;
  }
  return sites;
}

Eigen::MatrixXd dense(const Sites& sites, const Covariance& c) {
  const Index n = sites.size();
  Eigen::MatrixXd result(n, n);
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < n; ++j) {
      const Apart apart = i == j               ? Apart{0, 0}
                          : is_rough(c.family) ? readings_apart(sites, i, j)
                                               : middles_apart(sites, i, j);
      const bool same = sites.group[static_cast<std::size_t>(i)] == sites.group[static_cast<std::size_t>(j)];
      const auto k = [&](double h) { return correlation(c.family, h / c.decorrelation()); };
      result(i, j) = c.field_variance() * (c.shared() * k(apart.place) + (same ? (1 - c.shared()) * k(apart.both) : 0));
    }
    result(i, i) += c.reading_variance() / sites.count[i] + 1e-3;
  }
  return result;
}

const Covariance some{Family::exponential, {std::log(9.0), std::log(1.7), std::log(4.0), -1.2}};

TEST(ExactCovariance, OfSumsEqualsTheDenseOne) {
  const Eigen::MatrixXd weights = Eigen::MatrixXd::Random(83, 3);
  for (const bool anchors_move : {false, true}) {
    Sites sites = scattered(83, 3, 6);
    if (anchors_move) {
      sites.anchor.row(1).setRandom();
      sites.anchor_stretch.row(0).setConstant(0.1);
    }
    for (const Family family : families) {
      const Covariance c{family, some.theta};
      const Eigen::MatrixXd expected = weights.transpose() * dense(sites, c) * weights;
      EXPECT_LT((covariance_of_sums(Field(sites), c, weights) - expected).norm(), 1e-3 * expected.norm())
          << name_of(family);
    }
  }
}

// An offset of one radio in a field of two scales with dense readings. By few neighbours its gain is wider than
// chi-square, by the ratio of the exact covariance.
TEST(ExactCovariance, GainsOfPureNoiseAreChiSquare) {
  const Sites sites = scattered(900, 3, 7);
  const Covariance c{Family::two_scale, {std::log(9.0), std::log(2.0), std::log(2.0), -1.2}};
  const Field field(sites);
  const Whitener whitener(field, c);
  Eigen::MatrixXd columns(900, 2);
  for (Index i = 0; i < 900; ++i) columns.row(i) << 1, sites.group[static_cast<std::size_t>(i)] == 0;
  const Basis design = basis_of(whitener(columns.col(0)));
  const Basis added = basis_of(design.rest(whitener(columns.col(1))));
  const Eigen::MatrixXd root = dense(sites, c).llt().matrixL();
  const Stream stream(key_of("exact gains"));
  constexpr int draws = 400;
  double mean = 0, overstated = 0;
  for (uint64_t draw = 0; draw < draws; ++draw) {
    Eigen::VectorXd z(900);
    for (Index i = 0; i < 900; ++i) z[i] = stream.normal(static_cast<uint64_t>(i), draw);
    const Eigen::VectorXd residual = design.rest(whitener(Eigen::VectorXd(root * z))).col(0);
    const double gain = (added.q.transpose() * residual).squaredNorm();
    if (draw == 0) overstated = gain / exact_gain(field, whitener, added.q, residual);  // the same for any residual
    mean += gain / draws;
  }
  EXPECT_GT(overstated, 1.25);
  EXPECT_NEAR(mean / overstated, 1, 3 * std::sqrt(2.0 / draws));
}

TEST(Vecchia, IsTheDenseLikelihoodWhereEveryEarlierRowIsANeighbour) {
  const Sites sites = scattered(60, 3, 5);
  const Field field(sites, {60, 60, 1});
  for (const Family family : families) {
    const Covariance c{family, some.theta};
    const Whitener whitener(field, c);
    const Eigen::MatrixXd covariance = dense(sites, c);
    const Eigen::LLT<Eigen::MatrixXd> root(covariance);
    const double log_det = root.matrixLLT().diagonal().array().log().sum();
    EXPECT_NEAR(-whitener.log_scale(), log_det, 0.05) << name_of(family);
    Eigen::VectorXd y(60);
    for (Index i = 0; i < 60; ++i) y[i] = Stream(9).normal(static_cast<uint64_t>(i));
    EXPECT_NEAR(whitener(y).squaredNorm() / y.dot(root.solve(y)), 1, 4e-3) << name_of(family);
  }
}

// With one anchor, slots for other anchors would stay empty and cost time.
TEST(Vecchia, KeepsNoSlotsForOtherAnchorsWhereThereIsOne) {
  EXPECT_EQ(Field(scattered(50, 1, 5), {8, 7, 1}).slots(), 8);
  EXPECT_EQ(Field(scattered(50, 2, 5), {8, 7, 1}).slots(), 15);
}

TEST(Vecchia, WhitenedDrawsOfTheFieldAreIndependentWithVarianceOne) {
  const Index n = 400, draws = 300;
  const Sites sites = scattered(n, 3, 7);
  const Field field(sites);
  const Whitener whitener(field, some);
  const Eigen::MatrixXd root = dense(sites, some).llt().matrixL();
  Eigen::MatrixXd z(n, draws);
  for (Index j = 0; j < draws; ++j) {
    for (Index i = 0; i < n; ++i) z(i, j) = Stream(3).normal(static_cast<uint64_t>(i), static_cast<uint64_t>(j));
  }
  const Eigen::MatrixXd white = whitener(root * z);
  EXPECT_NEAR(white.squaredNorm() / static_cast<double>(n * draws), 1, 0.02);
  // Off-diagonal entries of the exact covariance, whitened on both sides, are the error of 14 neighbours.
  const Eigen::MatrixXd half = whitener(root);
  Eigen::MatrixXd unit = half * half.transpose();
  EXPECT_NEAR(unit.diagonal().mean(), 1, 0.005);
  unit.diagonal().setZero();
  EXPECT_LT(unit.cwiseAbs().maxCoeff(), 0.35);
  EXPECT_LT(std::sqrt(unit.squaredNorm() / static_cast<double>(n)), 0.25);
}

TEST(Vecchia, ASheetOfFloatsIsWhitenedAsDoublesAre) {
  const Field field(scattered(300, 2, 8));
  const Whitener whitener(field, some);
  Eigen::MatrixXd x(300, 150);
  for (Index j = 0; j < 150; ++j) {
    for (Index i = 0; i < 300; ++i) x(i, j) = Stream(4).normal(static_cast<uint64_t>(i), static_cast<uint64_t>(j));
  }
  const Sheet sheet = whitener.sheet(Sheet(x.cast<float>()));
  EXPECT_LT((sheet.cast<double>() - whitener(x)).cwiseAbs().maxCoeff(), 1e-5);
}

TEST(Reml, GradientMatchesFiniteDifferences) {
  const Field field(scattered(500, 3, 11));
  Eigen::MatrixXd design = Eigen::MatrixXd::Ones(500, 3);
  Eigen::VectorXd y(500);
  for (Index i = 0; i < 500; ++i) {
    const auto k = static_cast<uint64_t>(i);
    design(i, 1) = field.sites().place(0, i);
    design(i, 2) = Stream(6).normal(k);
    y[i] = 3 * Stream(5).normal(k);
  }
  for (const Family family : families) {
    const Covariance c{family, some.theta};
    const Prior prior;
    const Objective at = objective(field, c, y, design, prior);
    for (Index p = 0; p < 4; ++p) {
      const double h = 1e-4;
      const auto value = [&](double step) {
        Covariance moved = c;
        moved.theta[p] += step;
        return whitened(Whitener(field, moved), y, design, prior).value;
      };
      const double slope = (value(h) - value(-h)) / (2 * h);
      EXPECT_NEAR(at.gradient[p], slope, 1e-5 * (1 + std::abs(slope))) << name_of(family) << " " << p;
    }
  }
}

TEST(Reml, InformationIsTheExpectedCurvature) {
  const Sites sites = scattered(120, 2, 12);
  const Field field(sites, {120, 120, 1});
  const Eigen::MatrixXd covariance = dense(sites, some), inverse = covariance.inverse();
  const Eigen::Matrix4d information = WhitenerSlopes(field, some).information();
  std::array<Eigen::MatrixXd, 4> slopes;
  for (Index p = 0; p < 4; ++p) {
    Covariance up = some, down = some;
    up.theta[p] += 1e-4;
    down.theta[p] -= 1e-4;
    slopes[static_cast<std::size_t>(p)] = inverse * (dense(sites, up) - dense(sites, down)) / 2e-4;
  }
  for (std::size_t p = 0; p < 4; ++p) {
    for (std::size_t q = 0; q <= p; ++q) {
      const double exact = 0.5 * (slopes[p] * slopes[q]).trace();
      const auto a = static_cast<Index>(p), b = static_cast<Index>(q);
      EXPECT_NEAR(information(a, b), exact, 0.01 * std::sqrt(information(a, a) * information(b, b)));
    }
  }
}

TEST(Fit, RecoversTheTrueField) {
  std::vector<double> errors;
  for (uint64_t seed = 1; seed <= 8; ++seed) {
    const auto world = synthetic::world_of(synthetic::varied(seed, 4000));
    const Rows rows = diagnosis::link_rows(world.readings);
    const Field field(diagnosis::link_sites(rows, world.readings));
    const auto fits = fit_families(field, rows.mean(world.rssi), rows.mean(world.base), Prior());
    errors.push_back(
        std::abs(fits[0].covariance.theta[1] - world.true_theta[1] - log_scale_of(fits[0].covariance.family)));
    EXPECT_NEAR(fits[0].covariance.theta[2], world.true_theta[2], 0.7) << seed;  // the field within a row adds to it
    EXPECT_NEAR(fits[0].covariance.theta[0], world.true_theta[0], 0.6) << seed;
  }
  std::sort(errors.begin(), errors.end());
  EXPECT_LT(errors[4], 0.3);
}

TEST(Fit, DistinguishesASmoothFieldFromAnExponentialOne) {
  auto recipe = synthetic::varied(3, 5000);
  recipe.shape = synthetic::Shape::gaussian;
  const auto world = synthetic::world_of(recipe);
  const Rows rows = diagnosis::link_rows(world.readings);
  const Field field(diagnosis::link_sites(rows, world.readings));
  EXPECT_NE(fit_families(field, rows.mean(world.rssi), rows.mean(world.base), Prior())[0].covariance.family,
            Family::exponential);
}

// At the longest field that is allowed, the other entries are the likeliest beside it. The step to the free minimum,
// cut off there, led up, so that fits ended hundreds of nats short.
TEST(Fit, AtALimitIsTheBestThere) {
  auto recipe = synthetic::varied(3, 3000);
  recipe.decorrelation = 12;
  const auto world = synthetic::world_of(recipe);
  const Rows rows = diagnosis::link_rows(world.readings);
  const Field field(diagnosis::link_sites(rows, world.readings));
  const Eigen::VectorXd y = rows.mean(world.rssi);
  const Eigen::MatrixXd design = rows.mean(world.base);
  Prior prior;
  prior.log_longest = std::log(1.5);
  for (const Family family : {Family::exponential, Family::matern32}) {
    const Fit found = fit(field, y, design, prior, default_start(y, design, family), 30);
    EXPECT_EQ(found.covariance.theta[1], prior.log_longest) << name_of(family);
    for (const Index p : {0, 2, 3}) {
      for (const double by : {-0.2, 0.2}) {
        Covariance other = found.covariance;
        other.theta[p] += by;
        EXPECT_GT(objective(field, other, y, design, prior).value, found.value) << name_of(family) << ' ' << p;
      }
    }
  }
}

TEST(Fit, FromAFactorisedStartIsTheSame) {
  const auto world = synthetic::world_of(synthetic::varied(5, 3000));
  const Rows rows = diagnosis::link_rows(world.readings);
  const Field field(diagnosis::link_sites(rows, world.readings));
  const Eigen::VectorXd y = rows.mean(world.rssi);
  const Eigen::MatrixXd design = rows.mean(world.base);
  for (const Family family : {Family::exponential, Family::matern52}) {
    const Covariance start = default_start(y, design, family);
    const Fit afresh = fit(field, y, design, {}, start, 8);
    const WhitenerSlopes there(field, {family, Prior().inside(start.theta)});
    for (const Fit& again : {fit(field, y, design, {}, there, 8), fit_over_shares(field, y, design, {}, there, 8)}) {
      EXPECT_EQ(again.covariance.theta, afresh.covariance.theta);
      EXPECT_EQ(again.value, afresh.value);
      EXPECT_EQ(again.curvature, afresh.curvature);
    }
    const Whitened at = whitened(Whitener(field, afresh.covariance), y, design, {});
    EXPECT_NEAR(afresh.log_likelihood(), at.basis.log_determinant() - at.value, 1e-9);
  }
}

// A valid correlation: no combination of nearby rows has a negative variance.
TEST(Families, ArePositiveDefiniteOverRows) {
  Sites sites = scattered(60, 1, 21);
  sites.place *= 0.15;
  for (const Family family : families) {
    Covariance c{family, some.theta};
    c.theta[2] = std::log(1e-3);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(dense(sites, c), Eigen::EigenvaluesOnly);
    EXPECT_GT(solver.eigenvalues().minCoeff(), 0) << name_of(family);
  }
}

TEST(Reach, IsTheWhitenersTranspose) {
  const Field field(scattered(90, 3, 22));
  const Whitener whitener(field, some);
  const Reach reach(field, whitener);
  Eigen::VectorXd z(90);
  for (Index i = 0; i < 90; ++i) z[i] = Stream(7).normal(static_cast<uint64_t>(i));
  const Eigen::MatrixXd all = whitener(Eigen::MatrixXd::Identity(90, 90));
  EXPECT_LT((reach.transposed(z) - all.transpose() * z).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((whitener(z) - all * z).cwiseAbs().maxCoeff(), 1e-12);  // a single column has a code path of its own
}

TEST(Censored, ReadingsBelowAFloorAreReplacedByTheirExpectation) {
  const Index n = 20000;
  const double floor = -62;
  Eigen::MatrixXd design(n, 2);
  Eigen::VectorXd level(n), read(n);
  Bounds bounds{std::vector<Known>(n, Known::value), 0.5};
  for (Index i = 0; i < n; ++i) {
    const double u = Stream(21).uniform(static_cast<uint64_t>(i));
    design.row(i) << 1, u;
    level[i] = -50 - 15 * u + 4 * Stream(22).normal(static_cast<uint64_t>(i));
    read[i] = std::max(std::round(level[i]), floor);
    if (read[i] <= floor) bounds.known[static_cast<std::size_t>(i)] = Known::below;
  }
  const auto slope = [&](const Eigen::VectorXd& y) {
    const Basis basis = basis_of(design);
    return basis.coefficients(basis.q.transpose() * y, 2)[1];
  };
  EXPECT_GT(slope(read), -13.5);  // the floor flattens it
  EXPECT_NEAR(slope(imputed(read, bounds, design, 40)), -15, 0.4);
}

// Readings below a level are not there at all: what is left looks too flat.
TEST(Truncated, ReadingsBecomeThoseOfTheirRankAmongAll) {
  const double floor = -62;
  std::vector<double> at, heard;
  for (uint64_t i = 0; i < 20000; ++i) {
    const double u = Stream(21).uniform(i), level = -50 - 15 * u + 4 * Stream(22).normal(i);
    if (level < floor) continue;
    at.push_back(u);
    heard.push_back(level);
  }
  const auto n = static_cast<Index>(heard.size());
  const Eigen::VectorXd read = Eigen::Map<const Eigen::VectorXd>(heard.data(), n);
  Eigen::MatrixXd design(n, 2);
  design << Eigen::VectorXd::Ones(n), Eigen::Map<const Eigen::VectorXd>(at.data(), n);
  Bounds bounds{{}, 0, Eigen::VectorXd::Constant(n, floor)};
  const Basis basis = basis_of(design);
  const auto fitted = [&](const Eigen::VectorXd& y) { return basis.coefficients(basis.q.transpose() * y, 2); };
  const Eigen::VectorXd filled = imputed(read, bounds, design, 60);
  EXPECT_GT(fitted(read)[1], -13.5);
  EXPECT_NEAR(fitted(filled)[0], -50, 0.2);
  EXPECT_NEAR(fitted(filled)[1], -15, 0.4);
  EXPECT_NEAR(std::sqrt(basis.rest(filled).squaredNorm() / static_cast<double>(n)), 4, 0.1);
  // Each keeps its place among those of one mean, and those far above the floor their value.
  EXPECT_EQ((filled - read).maxCoeff() > 1e-6, false);
  EXPECT_NEAR(filled[std::distance(heard.begin(), std::max_element(heard.begin(), heard.end()))],
              *std::max_element(heard.begin(), heard.end()), 1e-2);
}

TEST(Bounds, AreMissedByTheDistanceFromWhatTheyAllow) {
  const Bounds bounds{{Known::value, Known::below, Known::above}, 0.5};
  EXPECT_EQ(bounds.error(0, -60, -57), 3);
  EXPECT_EQ(bounds.error(0, -60, -63), 3);
  EXPECT_EQ(bounds.error(1, -90, -95), 0);  // a floor: the level may be anywhere below
  EXPECT_EQ(bounds.error(1, -90, -89.5), 0);
  EXPECT_EQ(bounds.error(1, -90, -87), 2.5);
  EXPECT_EQ(bounds.error(2, -40, -20), 0);  // saturation
  EXPECT_EQ(bounds.error(2, -40, -44), 3.5);
  EXPECT_EQ(Bounds().error(7, -60, -62), 2);
}

TEST(FieldVariances, AreTheDiagonalOfTheExactCovariance) {
  const Field field(scattered(40, 3, 23));
  const Eigen::MatrixXd all = covariance_of_sums(field, some, Eigen::MatrixXd::Identity(40, 40));
  const Eigen::VectorXd of_reading = some.reading_variance() / field.sites().count.array();
  EXPECT_LT((all.diagonal() - of_reading - field_variances(field, some)).cwiseAbs().maxCoeff(), 2e-3);
}

TEST(BasisOf, LeavesOutWhatEarlierColumnsExplain) {
  Eigen::MatrixXd x(50, 4);
  for (Index i = 0; i < 50; ++i) {
    const double u = Stream(1).normal(static_cast<uint64_t>(i)), v = Stream(2).normal(static_cast<uint64_t>(i));
    x.row(i) << 1, u, 2 - 3 * u, v;
  }
  const Basis basis = basis_of(x);
  EXPECT_EQ(basis.kept, (std::vector<Index>{0, 1, 3}));
  const Eigen::VectorXd y = x * Eigen::Vector4d(1, 2, 0, 3);
  EXPECT_LT((basis.coefficients(basis.q.transpose() * y, 4) - Eigen::Vector4d(1, 2, 0, 3)).norm(), 1e-10);
}

}  // namespace
}  // namespace muster::noise
