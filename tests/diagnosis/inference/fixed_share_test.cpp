// Shares of the field that are fixed at a site: against dense covariances, and chosen for data that have them.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "diagnosis/inference/noise/exact_covariance.hpp"
#include "diagnosis/inference/noise/fit.hpp"
#include "muster/random.hpp"
#include "tests/diagnosis/inference/apart.hpp"

namespace muster::noise {
namespace {

// Links between standing radios of one anchor each, both ways, a few rows of each way.
Sites mesh(Index sites, Index rows_each_way) {
  const Stream s(17);
  const Index n = sites * 2 * rows_each_way;
  Sites result{Eigen::Matrix3Xd::Zero(3, n),
               Eigen::Matrix3Xd::Zero(3, n),
               Eigen::Matrix3Xd::Zero(3, n),
               Eigen::Matrix3Xd::Zero(3, n),
               {},
               Eigen::VectorXd::Constant(n, 2)};
  for (Index i = 0; i < n; ++i) {
    const Index site = i % sites;
    const auto k = static_cast<uint64_t>(site);
    result.place.col(i) << 9 * s.uniform(k, 0), 7 * s.uniform(k, 1), 0;
    result.group.push_back(static_cast<int>(site % 3));
    result.anchor.col(i) << 3.0 * static_cast<double>(site % 3), 1, 0;
    result.stream.push_back((i / sites) % 2 == 0);
  }
  return result;
}

// Rows of a site are equally near. The choice among them must not follow the map, or two maps differ by that choice.
TEST(Neighbours, OfASiteAreTheSameWhereverItLies) {
  const Sites here = mesh(12, 15);
  Sites there = here;
  there.place *= -3;
  there.place.row(1).array() += 40;
  for (Index i = 0; i < here.size(); ++i) there.anchor.col(i) << here.anchor(1, i), 5 - 2 * here.anchor(0, i), 1;
  const Conditioning conditioning{10, 0, 1};
  const std::vector<Index> a = neighbours_of(here, conditioning), b = neighbours_of(there, conditioning);
  const RecurringSites recurring(here);
  Index full = 0;
  for (Index i = 0; i < here.size(); ++i) {
    const auto of_site = [&](const std::vector<Index>& all) {
      std::vector<Index> result;
      for (Index slot = 0; slot < conditioning.slots(); ++slot) {
        const Index row = all[static_cast<std::size_t>(i * conditioning.slots() + slot)];
        if (row >= 0 && recurring.of(i, row) != Relation::apart) result.push_back(row);
      }
      return result;
    };
    EXPECT_EQ(of_site(a), of_site(b)) << i;
    full += static_cast<Index>(of_site(a).size()) == conditioning.slots();
  }
  EXPECT_GT(full, here.size() / 2);
}

Eigen::MatrixXd dense(const Sites& sites, const Covariance& c) {
  const Index n = sites.size();
  const RecurringSites recurring(sites);
  const double fixed = fixed_share(c.family);
  const std::array shared{0.0, fixed_to_site(c.family), fixed};  // by their relation
  Eigen::MatrixXd result(n, n);
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < n; ++j) {
      const Apart apart = i == j ? Apart{0, 0} : readings_apart(sites, i, j);
      const bool same = sites.group[static_cast<std::size_t>(i)] == sites.group[static_cast<std::size_t>(j)];
      const auto k = [&](double h) { return correlation(c.family, h / c.decorrelation()); };
      result(i, j) = c.field_variance() *
                     ((1 - fixed) * (c.shared() * k(apart.place) + (same ? (1 - c.shared()) * k(apart.both) : 0)) +
                      shared[static_cast<std::size_t>(recurring.of(i, j))]);
    }
    result(i, i) += c.reading_variance() / sites.count[i] + 1e-3;
  }
  return result;
}

const Theta some{std::log(16.0), std::log(1.7), std::log(2.0), -1.2};

std::vector<Family> all_fixed() { return Field(mesh(30, 2)).fixed_families(); }

// With every part of a share that may be a stream's own.
std::vector<Family> all_parts() {
  std::vector<Family> result;
  for (std::size_t part = 0; part < stream_parts.size(); ++part) {
    for (std::size_t k = 0; k < fixed_shares.size(); ++k) result.push_back(with_fixed(Family::exponential, k, part));
  }
  return result;
}

TEST(FixedShare, HasNextFamilies) {
  for (const Family family : all_parts()) {
    EXPECT_GE(fixed_share(with_more_fixed(family)), fixed_share(family));
    if (with_more_fixed(family) != family) {
      EXPECT_EQ(with_less_fixed(with_more_fixed(family)), family);
    }
    EXPECT_EQ(stream_part(with_less_fixed(family)), fixed_share(with_less_fixed(family)) > 0 ? stream_part(family) : 0);
    EXPECT_GE(stream_part(with_more_of_stream(family)), stream_part(family));
    if (with_more_of_stream(family) != family) {
      EXPECT_EQ(with_less_of_stream(with_more_of_stream(family)), family);
    }
    EXPECT_EQ(fixed_share(with_more_of_stream(family)), fixed_share(family));
  }
}

TEST(FixedShare, IsOfOneSite) {
  const Sites sites = mesh(30, 2);
  const RecurringSites recurring(sites);
  EXPECT_EQ(recurring.of(0, 30), Relation::site);
  EXPECT_EQ(recurring.of(0, 60), Relation::stream);
  EXPECT_EQ(recurring.of(0, 1), Relation::apart);
  EXPECT_DOUBLE_EQ(recurring.share(), 1);
  EXPECT_EQ(recurring.rows_with(30), (std::vector<Index>{0, 30, 60, 90}));
  Sites moved = sites;
  moved.place(0, 60) += 0.05;
  EXPECT_EQ(RecurringSites(moved).of(0, 60), Relation::apart);
}

// Rows that knew those of their own direction alone would hardly tell how the two differ.
TEST(FixedShare, LeavesADirectionsOffsetMostOfItsInformation) {
  const Sites sites = mesh(20, 12);
  const Field field(sites);
  Eigen::VectorXd offset(sites.size());
  for (Index i = 0; i < sites.size(); ++i) offset[i] = sites.stream[static_cast<std::size_t>(i)];
  for (const bool to_stream : {false, true}) {
    const Covariance c{with_fixed(Family::exponential, to_stream ? 0 : 4, to_stream), some};
    const double exact = offset.dot(dense(sites, c).llt().solve(offset));
    const double known = Whitener(field, c)(offset).squaredNorm();
    EXPECT_GT(known, 0.85 * exact) << name_of(c.family);
    EXPECT_LT(known, 1.2 * exact) << name_of(c.family);
  }
}

TEST(FixedShare, OnlyWhereSitesRecur) {
  EXPECT_EQ(all_fixed().size(), 2 * fixed_shares.size());
  Sites sites = mesh(60, 1);
  sites.stream.assign(sites.stream.size(), 0);  // twice the same way
  EXPECT_EQ(Field(sites).fixed_families().size(), fixed_shares.size());
  EXPECT_TRUE(Field(mesh(60, 1).of({0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12})).fixed_families().empty());
}

TEST(FixedShare, LikelihoodIsTheDenseOne) {
  const Sites sites = mesh(20, 2);
  const Field field(sites, {80, 80, 1});
  for (const Family family : all_parts()) {
    const Covariance c{family, some};
    const Whitener whitener(field, c);
    const Eigen::LLT<Eigen::MatrixXd> root(dense(sites, c));
    EXPECT_NEAR(-whitener.log_scale(), root.matrixLLT().diagonal().array().log().sum(), 0.05) << name_of(family);
    Eigen::VectorXd y(80);
    for (Index i = 0; i < 80; ++i) y[i] = Stream(9).normal(static_cast<uint64_t>(i));
    EXPECT_NEAR(whitener(y).squaredNorm() / y.dot(root.solve(y)), 1, 4e-3) << name_of(family);
    const Eigen::MatrixXd weights = Eigen::MatrixXd::Random(80, 3),
                          expected = weights.transpose() * dense(sites, c) * weights;
    EXPECT_LT((covariance_of_sums(field, c, weights) - expected).norm(), 1e-3 * expected.norm()) << name_of(family);
  }
}

TEST(FixedShare, GradientIsThatOfDifferences) {
  const Sites sites = mesh(40, 3);
  const Field field(sites);
  const Eigen::MatrixXd design = Eigen::MatrixXd::Ones(sites.size(), 1);
  const Prior prior;
  Eigen::VectorXd y(sites.size());
  for (Index i = 0; i < y.size(); ++i) y[i] = 3 * Stream(4).normal(static_cast<uint64_t>(i));
  for (const Family family : all_parts()) {
    const Objective at = objective(field, {family, some}, y, design, prior);
    for (Index p = 0; p < 4; ++p) {
      Theta up = some, down = some;
      up[p] += 1e-4;
      down[p] -= 1e-4;
      const double slope = (objective(field, {family, up}, y, design, prior).value -
                            objective(field, {family, down}, y, design, prior).value) /
                           2e-4;
      EXPECT_NEAR(at.gradient[p], slope, 1e-4 * (1 + std::abs(slope))) << name_of(family) << " " << p;
    }
  }
}

// A mesh whose links differ by the way, as no field over places can: its share is found, and none where there is none.
TEST(FixedShare, IsFoundInTheDataThatHaveIt) {
  const Sites sites = mesh(45, 12);
  const Field field(sites);
  const Eigen::MatrixXd design = Eigen::MatrixXd::Ones(sites.size(), 1);
  const Stream stream(21);
  for (const Family family :
       {Family::exponential, with_fixed(Family::exponential, 2, 1), with_fixed(Family::exponential, 3, 0)}) {
    const Eigen::MatrixXd root = dense(sites, {family, some}).llt().matrixL();
    Eigen::VectorXd z(sites.size());
    for (Index i = 0; i < z.size(); ++i) z[i] = stream.normal(static_cast<uint64_t>(i), static_cast<uint64_t>(family));
    const std::vector<Fit> fits = fit_families(field, root * z, design, {});
    const Family found = fits[0].covariance.family;
    EXPECT_NEAR(fixed_share(found), fixed_share(family), 0.31) << name_of(found) << " for " << name_of(family);
    EXPECT_EQ(stream_part(found) == 1 && fixed_share(found) > 0.05, stream_part(family) == 1) << name_of(found);
  }
}

// What is given up early would not have won: the same as a climb over shares each of which is fitted to the end.
TEST(FixedShare, IsTheBestOfItsNeighboursFittedInFull) {
  const Sites sites = mesh(45, 12);
  const Field field(sites);
  const Eigen::MatrixXd design = Eigen::MatrixXd::Ones(sites.size(), 1);
  const Stream stream(22);
  int moved = 0;
  for (uint64_t draw = 0; draw < 24; ++draw) {
    const Family family = with_fixed(Family::exponential, draw % 4, draw % 2 == 0);
    const Eigen::MatrixXd root = dense(sites, {family, some}).llt().matrixL();
    Eigen::VectorXd z(sites.size());
    for (Index i = 0; i < z.size(); ++i) z[i] = stream.normal(static_cast<uint64_t>(i), draw);
    const Eigen::VectorXd y = root * z;
    const Covariance start{with_fixed(Family::exponential, (draw + 1) % 4, draw % 2 == 0),
                           Prior().inside(default_start(y, design, Family::exponential).theta)};
    const WhitenerSlopes there(field, start);
    Fit best = fit(field, y, design, {}, there, 6);
    for (const bool less : {true, false}) {
      while (true) {
        const Family from = best.covariance.family, next = less ? with_less_fixed(from) : with_more_fixed(from);
        if (next == from || fixed_share(next) == 0) break;
        const Fit other = fit(field, y, design, {}, {next, best.covariance.theta}, 6);
        if (!(other.value < best.value)) break;
        best = other;
      }
    }
    const Fit found = fit_over_shares(field, y, design, {}, there, 6);
    EXPECT_EQ(found.covariance.family, best.covariance.family) << draw;
    EXPECT_EQ(found.value, best.value) << draw;
    moved += found.covariance.family != start.family;
  }
  EXPECT_GT(moved, 8);
}

}  // namespace
}  // namespace muster::noise
