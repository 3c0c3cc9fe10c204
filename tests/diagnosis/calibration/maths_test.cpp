// The two minimisers against a closed form, null directions, tests of missing readings, and tails of counts.
#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>
#include <random>

#include "diagnosis/calibration/distributions.hpp"
#include "diagnosis/calibration/identifiability.hpp"
#include "diagnosis/calibration/least_squares.hpp"
#include "diagnosis/calibration/missing_data.hpp"
#include "diagnosis/calibration/residual_covariance.hpp"

namespace muster::diagnosis {
namespace {

// Readings of a channel l0, n, loss with normal errors.
struct Channel {
  Eigen::MatrixXd columns;
  Readings readings;
  Box box;

  explicit Channel(int rows, double sd, unsigned seed) : columns(rows, 3) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> any(0, 1);
    std::normal_distribution<double> error(0, sd);
    readings.rssi.resize(rows);
    for (int i = 0; i < rows; ++i) {
      columns.row(i) << -1, -10 * std::log10(1 + 30 * any(random)), -std::floor(4 * any(random));
      readings.rssi[i] = columns.row(i).dot(truth()) + error(random);
      readings.heard.push_back(i);
    }
    box = {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(150, 10, 100)};
  }
  static Eigen::Vector3d truth() { return {40, 1.7, 4}; }
  Mean mean() const {
    return [this](const Eigen::VectorXd& x) -> Eigen::VectorXd { return columns * x; };
  }
};

TEST(Minimisers, AgreeWithTheClosedForm) {
  const Channel channel(20000, 5.57, 1);
  const Eigen::VectorXd exact = channel.columns.colPivHouseholderQr().solve(channel.readings.rssi);
  const Eigen::Vector3d start(30, 2.5, 2);
  const Minimum a = least_squares(channel.readings, channel.mean(), start, channel.box);
  const Minimum b = derivative_free_fit(channel.readings, channel.mean(), start, channel.box);
  EXPECT_TRUE(a.converged);
  EXPECT_LT((a.parameters - exact).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT((b.parameters - exact).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_LT(b.evaluations, 1500);
}

TEST(Minimisers, StayInsideTheBounds) {
  Channel channel(2000, 1, 2);
  channel.box.upper[1] = 1.5;  // below the truth
  for (const auto& found :
       {least_squares(channel.readings, channel.mean(), Eigen::Vector3d(30, 1, 2), channel.box),
        derivative_free_fit(channel.readings, channel.mean(), Eigen::Vector3d(30, 1, 2), channel.box)}) {
    EXPECT_NEAR(found.parameters[1], 1.5, 1e-9);
    EXPECT_TRUE(found.at_bound[1]);
    EXPECT_FALSE(found.at_bound[0]);
  }
}

TEST(Minimisers, ACurvedModel) {
  Channel channel(3000, 0.5, 3);
  const Mean mean = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {  // walls that saturate
    return channel.columns.leftCols(2) * x.head(2) - x[2] * (1 - (channel.columns.col(2) / 2).array().exp()).matrix();
  };
  const Eigen::VectorXd clean = mean(Eigen::Vector3d(45, 1.2, 9));
  channel.readings.rssi = clean;
  const Minimum a = least_squares(channel.readings, mean, Eigen::Vector3d(30, 3, 1), channel.box);
  EXPECT_LT((a.parameters - Eigen::Vector3d(45, 1.2, 9)).cwiseAbs().maxCoeff(), 1e-7);
}

TEST(Minimisers, CensoredReadingsDoNotBend) {
  Channel channel(20000, 6, 4);
  const double floor = -75;
  Readings cut = channel.readings;
  cut.heard.clear();
  for (Eigen::Index i = 0; i < cut.rssi.size(); ++i) (cut.rssi[i] >= floor ? cut.heard : cut.censored).push_back(i);
  ASSERT_GT(cut.censored.size(), 1500u);
  Readings heard_only = cut;
  heard_only.censored.clear();
  cut.floor = floor;
  const Eigen::Vector3d start(30, 2.5, 2);
  const Minimum naive = least_squares(heard_only, channel.mean(), start, channel.box);
  const Minimum a = least_squares(cut, channel.mean(), start, channel.box);
  const Minimum b = derivative_free_fit(cut, channel.mean(), start, channel.box);
  EXPECT_GT(std::abs(naive.parameters[1] - 1.7), 0.1);
  EXPECT_NEAR(a.parameters[1], 1.7, 0.05);
  EXPECT_NEAR(a.sigma, 6, 0.15);
  EXPECT_LT((a.parameters - b.parameters).cwiseAbs().maxCoeff(), 1e-5);
}

TEST(Identifiable, NamesWhatNoReadingDependsOn) {
  Eigen::MatrixXd slopes = Eigen::MatrixXd::Random(50, 3);
  slopes.col(1).setZero();
  const auto blind = blindnesses(slopes, Eigen::Vector3d(100, 100, 100));
  ASSERT_EQ(blind.size(), 1u);
  EXPECT_EQ(in_words(blind[0], {"a", "material/lead/loss", "c"}, {"", "dB", ""}),
            "no reading depends on material/lead/loss");
}

TEST(Identifiable, NamesTheCombination) {
  Eigen::MatrixXd slopes = Eigen::MatrixXd::Random(50, 3);
  slopes.col(2) = -slopes.col(0);
  const auto blind = blindnesses(slopes, Eigen::Vector3d(100, 10, 100));
  ASSERT_EQ(blind.size(), 1u);
  EXPECT_EQ(in_words(blind[0], {"tx_power", "n", "l0"}, {"dBm", "", "dB"}),
            "changing tx_power by 1 dBm together with l0 by 1 dB changes no reading");
}

TEST(Identifiable, SaysNothingOfASoundFit) {
  EXPECT_TRUE(blindnesses(Channel(100, 1, 5).columns, Eigen::Vector3d(150, 10, 100)).empty());
}

MissingData missing_where(const std::function<bool(double level, double chance)>& lost) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> any(0, 1);
  std::normal_distribution<double> error(0, 6);
  Eigen::VectorXd rssi(20000), mean(20000);
  for (Eigen::Index i = 0; i < mean.size(); ++i) {
    mean[i] = -90 + 50 * any(random);
    const double level = mean[i] + error(random);
    rssi[i] = lost(level, any(random)) ? std::nan("") : level;
  }
  return missing_data(rssi, mean, 6);
}

TEST(MissingData, RandomLossIsCalledRandom) {
  const MissingData found = missing_where([](double, double chance) { return chance < 0.1; });
  EXPECT_FALSE(found.censored);
  EXPECT_NEAR(static_cast<double>(found.count), 2000, 200);
}

TEST(MissingData, AFloorIsCalledAFloor) {
  const MissingData found = missing_where([](double level, double) { return level < -80; });
  EXPECT_TRUE(found.censored);
  EXPECT_NEAR(found.floor, -80, 1.1);
  EXPECT_GT(found.by_floor, 0.9);
  EXPECT_GT(found.bins.front().missing / found.bins.front().rows, 0.8);
  EXPECT_EQ(found.bins.back().missing, 0);
}

TEST(MissingData, AFloorBesideMuchRandomLossCutsLevelsOff) {
  const MissingData found = missing_where([](double level, double chance) { return level < -93 || chance < 0.1; });
  EXPECT_FALSE(found.censored);
  EXPECT_LT(found.by_floor, 0.3);
  EXPECT_TRUE(found.cut_off);
  EXPECT_GT(found.evidence, 30);
  EXPECT_FALSE(missing_where([](double, double chance) { return chance < 0.1; }).cut_off);
}

// With few losses the floor is at the weakest received reading, not at a quantile of one in a thousand.
TEST(MissingData, AFloorInTheTailTakesFew) {
  const MissingData alone = missing_where([](double level, double) { return level < -101; });
  EXPECT_LT(alone.count, 50u);
  EXPECT_TRUE(alone.censored);
  EXPECT_NEAR(alone.floor, -101, 0.5);
  const MissingData beside = missing_where([](double level, double chance) { return level < -98 || chance < 0.1; });
  EXPECT_TRUE(beside.cut_off);
  EXPECT_NEAR(beside.floor, -98, 0.5);
  const MissingData few = missing_where([](double level, double chance) { return level < -100 || chance < 0.05; });
  EXPECT_LT(few.evidence, 10);  // for the rise alone
  EXPECT_TRUE(few.cut_off);
  EXPECT_NEAR(few.floor, -100, 0.5);
}

// Behind 60 dB of rock all is lost, below what the world's receiver hears; nothing else is weaker than -80 dBm.
TEST(MissingData, TheStatedFloorExplainsLossesBehindAGap) {
  Eigen::VectorXd mean(1300), rssi(1300);
  mean.head(1250).setLinSpaced(-78, -50);
  mean.tail(50).setLinSpaced(-125, -112);
  rssi = mean;
  rssi.tail(50).setConstant(std::nan(""));
  EXPECT_GT(missing_data(rssi, mean, 2).beyond_stated, 300);
  EXPECT_LT(missing_data(rssi, mean, 2, -110).beyond_stated, 20);
  EXPECT_GT(missing_data(rssi, mean, 2, -130).beyond_stated, 200);  // which hears them
}

// Of seven weak readings three are lost, and one of -96 dBm was received.
TEST(MissingData, NoFloorIsAboveAReadingThatWasReceived) {
  Eigen::VectorXd mean(1300), rssi(1300);
  mean.head(1293).setLinSpaced(-75, -50);
  mean.tail(7).setConstant(-92);
  rssi = mean;
  rssi.tail(7) << -91, std::nan(""), -93, std::nan(""), -92, std::nan(""), -96;
  EXPECT_EQ(missing_data(rssi, mean, 4).floor, -96);
  rssi[1299] = -93;
  EXPECT_EQ(missing_data(rssi, mean, 4).floor, -93);
}

// A receiver that loses half of all readings, and more of weak ones.
TEST(MissingData, ALossThatRisesGentlyIsNoFloorAndNotChance) {
  const auto gentle = [](double level, double chance) { return chance > 0.5 / (1 + std::exp((-78 - level) / 5)); };
  const MissingData found = missing_where(gentle);
  EXPECT_FALSE(found.censored);
  EXPECT_FALSE(found.cut_off);
  EXPECT_TRUE(found.rises());
  EXPECT_FALSE(missing_where([](double, double chance) { return chance < 0.5; }).rises());
}

TEST(MissingData, NothingMissing) {
  EXPECT_FALSE(missing_where([](double, double) { return false; }).rises());
  EXPECT_EQ(missing_where([](double, double) { return false; }).count, 0u);
}

// Shapes are means over examples of clusters, and need not be covariances.
TEST(ErrorModels, OutliveShapesThatAreNoCovariance) {
  constexpr int rows_each = 100;
  Clusters clusters{{}, {rows_each, rows_each, rows_each}, {}};
  Eigen::VectorXd residual(3 * rows_each);
  std::mt19937 random(3);
  std::normal_distribution<double> error(0, 1);
  for (int i = 0; i < residual.size(); ++i) {
    const int cluster = i / rows_each;
    clusters.of_row.push_back(cluster);
    residual[i] = 10 * (cluster - 1) + error(random);
  }
  const Eigen::Matrix3d shape{{1, 5, 5}, {5, 1, 5}, {5, 5, 1}};
  const Eigen::Vector3d apart(1, -1, 0);
  ASSERT_LT(apart.dot(shape * apart), 0);
  const std::vector<Kernels> kernels{{1.8, {shape, shape}}};
  ErrorModel errors(clusters, kernels);
  const Eigen::MatrixXd constant = Eigen::MatrixXd::Ones(residual.size(), 1);
  errors.fit(residual, constant);
  EXPECT_FALSE(errors.components().empty());
  EXPECT_TRUE(std::isfinite(errors.shared_sd()));
  EXPECT_NEAR(errors.white_sd(), 1, 0.2);
  const double variance = errors.of_sums(constant)(0, 0);
  EXPECT_TRUE(std::isfinite(variance));
  EXPECT_GT(variance, 0);
}

TEST(PoissonTail, IsWhatTheTermsOfTheSeriesLeave) {
  for (const double mean : {0.05, 1.7, 25.0}) {
    double left = 1, term = std::exp(-mean);
    for (int count = 1; count < 40; ++count) {
      left -= term;
      term *= mean / count;
      EXPECT_NEAR(poisson_tail(mean, count), left, 1e-12) << mean << ' ' << count;
    }
  }
}

}  // namespace
}  // namespace muster::diagnosis
