// Twins: the two directions of a link at one moment, as rows of means and of half differences. The truth is the dense
// covariance of all readings.
#include "diagnosis/radio/links/twin_readings.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "diagnosis/inference/noise/exact_covariance.hpp"
#include "diagnosis/inference/noise/fit.hpp"
#include "muster/random.hpp"

namespace muster::diagnosis {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

const Stream stream(23);

double normal(Index i, uint64_t kind) { return stream.normal(static_cast<uint64_t>(i), kind); }

// Two stations and a robot that passes them; at each moment both directions of both links. Readings 4 k to 4 k + 3.
LinkReadings both_ways(Index moments, double late = 0) {
  LinkReadings r;
  r.tx_at = r.rx_at = Eigen::Matrix3Xd::Zero(3, 4 * moments);
  for (Index i = 0; i < 4 * moments; ++i) {
    const Index moment = i / 4;
    const bool down = i % 2 == 1;
    const int station = i % 4 < 2 ? 0 : 1;
    const Eigen::Vector3d robot(0.3 * static_cast<double>(moment), 0.5, 0), mast(2.0 + 5 * station, 3, 0);
    r.tx.push_back(down ? 2 : station);
    r.rx.push_back(down ? station : 2);
    r.tx_at.col(i) = down ? robot : mast;
    r.rx_at.col(i) = down ? mast : robot;
    r.t.push_back(0.5 * static_cast<double>(moment) + (down ? late : 0));
  }
  return r;
}

// Fades that both directions share, and what only one of them has.
VectorXd scattered(Index size, double shared, double own) {
  VectorXd result(size);
  for (Index i = 0; i < size; ++i) result[i] = shared * normal(i / 2, 1) + own * normal(i, 2);
  return result;
}

TEST(TwinReadings, AreTheTwoDirectionsOfAMoment) {
  LinkReadings r = both_ways(60);
  find_twins(r, scattered(r.size(), 3, 0.5));
  ASSERT_FALSE(r.twin.empty());
  for (Index i = 0; i < r.size(); ++i) EXPECT_EQ(r.twin[static_cast<std::size_t>(i)], i % 2 == 0 ? i + 1 : i - 1);
  EXPECT_NEAR(r.twin_variance, 0.5 * 0.5 / 2, 0.04);
}

// Rounded to whole decibels directions are alike, until one of them is a little off: half of two roundings, each of a
// twelfth.
TEST(TwinReadings, AreRoundedEachForItself) {
  LinkReadings r = both_ways(60);
  const VectorXd alike = scattered(r.size(), 3, 0).array().round();
  find_twins(r, alike, 1);
  ASSERT_FALSE(r.twin.empty());
  EXPECT_NEAR(r.twin_variance, 1.0 / 24, 1e-12);
}

// A few readings of one direction that are far off hide nothing of what the rest share.
TEST(TwinReadings, AreTwinsBesideOutliers) {
  LinkReadings r = both_ways(200);
  VectorXd residual = scattered(r.size(), 3, 0.3);
  for (Index i = 0; i < r.size(); i += 23) residual[i] += 18 * (i % 2 == 0 ? 1 : -1);
  find_twins(r, residual);
  ASSERT_FALSE(r.twin.empty());
  EXPECT_GT(r.twin_variance, 3);  // their differences do vary
}

TEST(TwinReadings, AreNoneWhereTheyScatterApart) {
  LinkReadings r = both_ways(60);
  find_twins(r, scattered(r.size(), 0, 3));
  EXPECT_TRUE(r.twin.empty());
}

TEST(TwinReadings, AreNoneAtAnotherMomentOrPlace) {
  LinkReadings r = both_ways(60, 0.2);
  find_twins(r, scattered(r.size(), 3, 0.5));
  EXPECT_TRUE(r.twin.empty());
  r = both_ways(60);
  for (Index i = 1; i < r.size(); i += 2) r.tx_at(1, i) += 0.1;
  find_twins(r, scattered(r.size(), 3, 0.5));
  EXPECT_TRUE(r.twin.empty());
}

TEST(TwinReadings, NeedMoreThanAFew) {
  LinkReadings r = both_ways(10);
  find_twins(r, scattered(r.size(), 3, 0.5));
  EXPECT_TRUE(r.twin.empty());
}

// A lost reading leaves the other direction a reading of its own.
TEST(TwinReadings, ALostReadingHasNoTwin) {
  LinkReadings r = both_ways(60);
  VectorXd residual = scattered(r.size(), 3, 0.5);
  residual[5] = std::nan("");
  find_twins(r, residual);
  EXPECT_EQ(r.twin[4], -1);
  EXPECT_EQ(r.twin[5], -1);
  EXPECT_EQ(r.twin[6], 7);
}

TEST(TwinRows, HoldAllThatTheirReadingsHold) {
  LinkReadings r = both_ways(60);
  find_twins(r, scattered(r.size(), 3, 0.5));
  const noise::Rows rows = link_rows(r, {.way = -1});  // each moment a row
  ASSERT_EQ(rows.size(), r.size());
  ASSERT_EQ(rows.means(), r.size() / 2);
  MatrixXd values(r.size(), 2);
  for (Index i = 0; i < r.size(); ++i) values.row(i) << normal(i, 5), normal(i, 6);
  const MatrixXd means = rows.mean(values);
  for (Index j = 0; j < 2; ++j) EXPECT_LT((rows.at_readings(means.col(j)) - values.col(j)).norm(), 1e-12);
  EXPECT_LT((rows.by_twins(rows.by_stream(means)) - means).norm(), 1e-12);
  for (Index i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows.example(i) % 2, rows.is_difference(i) ? 1 : 0);
    EXPECT_NEAR(rows.by_stream(means)(i, 0), values(rows.example(i), 0), 1e-12);
  }
}

// Longer rows: by_stream() has the mean of each direction.
TEST(TwinRows, AreMeansOfEitherDirectionByStream) {
  LinkReadings r = both_ways(60);
  const VectorXd values = scattered(r.size(), 3, 0.5);
  const noise::Rows apart = link_rows(r);
  find_twins(r, values);
  const noise::Rows rows = link_rows(r);
  ASSERT_EQ(rows.size(), apart.size());
  const VectorXd by_stream = rows.by_stream(rows.mean(values)), each = apart.mean(values);
  for (Index i = 0; i < rows.size(); ++i) {
    const Index same = apart.row_of()[static_cast<std::size_t>(rows.example(i))];
    EXPECT_NEAR(by_stream[i], each[same], 1e-12);
    EXPECT_EQ(rows.count()[i], apart.count()[same]);
  }
}

TEST(TwinRows, EndTogetherWhereAnEffectSetsIn) {
  LinkReadings r = both_ways(60);
  const VectorXd residual = scattered(r.size(), 3, 0.5);
  find_twins(r, residual);
  const noise::Rows rows = link_rows(r);
  VectorXd effect(r.size());  // on one direction alone
  for (Index i = 0; i < r.size(); ++i) effect[i] = i % 4 == 1 && r.t[static_cast<std::size_t>(i)] > 8.2 ? 3 : 0;
  std::vector<Index> parent;
  const noise::Rows more = rows.ended_where(effect, 1, parent);
  EXPECT_EQ(more.size(), rows.size() + 2);
  EXPECT_EQ(more.means(), rows.means() + 1);
  ASSERT_EQ(static_cast<Index>(parent.size()), more.size());
  for (Index i = 0; i < more.size(); ++i) {
    EXPECT_EQ(more.is_difference(i), rows.is_difference(parent[static_cast<std::size_t>(i)]));
    const Index of = parent[static_cast<std::size_t>(i)];
    EXPECT_EQ(rows.row_of()[static_cast<std::size_t>(more.example(i))],
              rows.row_of()[static_cast<std::size_t>(rows.example(of))]);
  }
  EXPECT_TRUE(std::is_sorted(parent.begin(), parent.end()));
}

// Covariance of all readings: the field and the fade shared by both directions, and what only one has.
struct Truth {
  LinkReadings readings;
  noise::Covariance covariance{noise::Family::exponential, {std::log(9.0), std::log(2.0), std::log(6.0), -1}};
  double own = 0.4;  // dB^2

  Truth() : readings(both_ways(25)) {
    find_twins(readings, scattered(readings.size(), 3, std::sqrt(own)));
    readings.twin_variance = own / 2;
    covariance.theta[2] = std::log(6.0 + own / 2);
  }

  MatrixXd dense() const {
    const Index n = readings.size();
    MatrixXd result(n, n);
    const auto end = [&](Index i, int radio) -> Eigen::Vector3d {
      return (readings.tx[static_cast<std::size_t>(i)] == radio ? readings.tx_at : readings.rx_at).col(i);
    };
    for (Index i = 0; i < n; ++i) {
      for (Index j = 0; j < n; ++j) {
        const double apart = (end(i, 2) - end(j, 2)).norm();
        const bool same_link = (i % 4) / 2 == (j % 4) / 2;
        result(i, j) = 9 * std::exp(-apart / 2) * (same_link ? 1 : covariance.shared());
        if (i / 2 == j / 2) result(i, j) += 6;
        if (i == j) result(i, j) += own;
      }
    }
    return result;
  }
};

TEST(TwinRows, HaveTheLikelihoodOfAllReadings) {
  const Truth truth;
  const noise::Rows rows = link_rows(truth.readings, {.way = -1});
  const noise::Field field(link_sites(rows, truth.readings), {60, 60, 1});
  MatrixXd to_rows = rows.mean(MatrixXd::Identity(truth.readings.size(), truth.readings.size()));
  const MatrixXd expected = to_rows * truth.dense() * to_rows.transpose();
  const MatrixXd all = MatrixXd::Identity(rows.size(), rows.size());
  const MatrixXd found = noise::covariance_of_sums(field, truth.covariance, all);
  EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), 3e-3);
  const noise::Whitener whitener(field, truth.covariance);
  const Eigen::LLT<MatrixXd> root(expected);
  EXPECT_NEAR(-whitener.log_scale(), root.matrixLLT().diagonal().array().log().sum(), 0.2);
  VectorXd y(rows.size());
  for (Index i = 0; i < y.size(); ++i) y[i] = normal(i, 9);
  EXPECT_NEAR(whitener(y).squaredNorm() / y.dot(root.solve(y)), 1, 1e-2);
}

TEST(TwinRows, GradientIsThatOfDifferences) {
  const Truth truth;
  const noise::Rows rows = link_rows(truth.readings, {.way = -1});
  const noise::Field field(link_sites(rows, truth.readings));
  const MatrixXd design = rows.mean(MatrixXd::Ones(truth.readings.size(), 1));
  const VectorXd y = rows.mean(scattered(truth.readings.size(), 3, 0.6));
  const noise::Prior prior;
  const noise::Objective at = noise::objective(field, truth.covariance, y, design, prior);
  for (Index p = 0; p < 4; ++p) {
    noise::Covariance up = truth.covariance, down = truth.covariance;
    up.theta[p] += 1e-4;
    down.theta[p] -= 1e-4;
    const double slope =
        (noise::objective(field, up, y, design, prior).value - noise::objective(field, down, y, design, prior).value) /
        2e-4;
    EXPECT_NEAR(at.gradient[p], slope, 1e-4 * (1 + std::abs(slope))) << p;
  }
}

// With fades shared, the offset of a sender that both directions show apart is known from their differences alone.
TEST(TwinRows, KnowAnOffsetFromDifferences) {
  const Truth truth;
  const noise::Rows rows = link_rows(truth.readings, {.way = -1});
  const noise::Field field(link_sites(rows, truth.readings));
  VectorXd sent(truth.readings.size());
  for (Index i = 0; i < sent.size(); ++i) sent[i] = truth.readings.tx[static_cast<std::size_t>(i)] == 2 ? 1 : 0;
  const VectorXd column = rows.mean(sent);
  const double information = noise::Whitener(field, truth.covariance)(column).squaredNorm();
  const double of_differences = static_cast<double>(rows.size() - rows.means()) / 4 / (truth.own / 2 + 1e-3);
  EXPECT_GT(information, of_differences);
  EXPECT_LT(information, 1.1 * of_differences);
}

}  // namespace
}  // namespace muster::diagnosis
