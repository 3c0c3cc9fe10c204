// Draws of censored readings against the truncated normal distribution, and the noise that is fitted to them.
#include "diagnosis/inference/noise/censored_draws.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <numeric>

#include "diagnosis/inference/state/model_state.hpp"
#include "muster/random.hpp"
#include "tests/diagnosis/inference/causes.hpp"

namespace muster::noise {
namespace {

double above(double z) { return 0.5 * std::erfc(z / std::sqrt(2.0)); }
double hazard(double z) { return std::exp(-z * z / 2) / std::sqrt(2 * M_PI) / above(z); }

TEST(NormalAbove, HasThatShareOfTheTailAboveIt) {
  for (const double end : {-12.0, -3.0, 0.0, 1.5, 5.5}) {
    for (const double share : {1e-6, 0.01, 0.5, 0.99}) {
      const double x = normal_above(end, share);
      EXPECT_GE(x, end);
      EXPECT_NEAR(above(x) / above(end), share, 1e-6 * share + 1e-9) << end << ' ' << share;
    }
  }
  EXPECT_NEAR(normal_above(40, 0.5), 40 + std::log(2) / 40, 1e-4);  // beyond where the tail underflows
}

// Readings on a line, `apart` m from each other, one a row, or several at each place.
struct Line {
  Sites sites;
  Rows rows;

  Line(Index places, Index each, double apart, std::vector<Index> twin = {})
      : rows(order(places * each, !twin.empty()), first(places, each), twin) {
    const Index n = rows.size();
    sites.place = sites.anchor = sites.place_stretch = sites.anchor_stretch = Eigen::Matrix3Xd::Zero(3, n);
    for (Index i = 0; i < n; ++i) sites.place(0, i) = apart * static_cast<double>(i % places);
    sites.group.assign(static_cast<std::size_t>(n), 0);
    sites.count = rows.count();
    if (twin.empty()) return;
    for (Index i = 0; i < n; ++i) sites.alone.push_back(rows.is_difference(i) ? 0.5 : 0);
  }
  static std::vector<Index> order(Index n, bool twins) {
    std::vector<Index> result(static_cast<std::size_t>(n));
    std::iota(result.begin(), result.end(), Index{0});
    if (twins) {
      for (Index& reading : result) reading *= 2;
    }
    return result;
  }
  static std::vector<Index> first(Index places, Index each) {
    std::vector<Index> result;
    for (Index i = 0; i <= places; ++i) result.push_back(i * each);
    return result;
  }
};

struct Moments {
  Eigen::VectorXd mean, sd;
};

// Of the readings in many sweeps, after some to forget the start.
Moments moments_of(const CensoredDraws& draws, Eigen::VectorXd filled) {
  constexpr int sweeps = 4000;
  const Eigen::VectorXd mean = Eigen::VectorXd::Zero(filled.size());
  Eigen::VectorXd sum = mean, squares = mean;
  for (uint64_t k = 0; k < sweeps + 50; ++k) {
    draws.sweep(k, mean, filled);
    if (k < 50) continue;
    sum += filled;
    squares += filled.cwiseAbs2();
  }
  sum /= sweeps;
  return {sum, (squares / sweeps - sum.cwiseAbs2()).cwiseMax(0).cwiseSqrt()};
}

// White noise of 2 dB: the moments of the truncated normal, below a floor and above a ceiling.
TEST(CensoredDraws, HaveTheMomentsOfTheirDistribution) {
  const Line line(4, 1, 1000);
  const Field field(line.sites);
  const Whitener whitener(field, {Family::exponential, {std::log(1e-9), 0, std::log(4.0), 0}});
  const Eigen::VectorXd readings = Eigen::Vector4d(1, -2, 1.5, 0.7);
  const Bounds bounds{{Known::below, Known::below, Known::above, Known::value}, 0.5};
  const Moments got = moments_of({readings, bounds, line.rows, field, whitener}, readings);
  const auto expect = [&](Index i, double z, double side) {  // z: of the bound, on the side where the level is
    EXPECT_NEAR(got.mean[i], side * 2 * hazard(z), 0.12) << i;
    EXPECT_NEAR(got.sd[i], 2 * std::sqrt(1 - hazard(z) * (hazard(z) - z)), 0.08) << i;
  };
  expect(0, -0.75, -1);
  expect(1, 0.75, -1);
  expect(2, 0.5, 1);
  EXPECT_NEAR(got.mean[3], 0.7, 1e-9);
  EXPECT_LT(got.sd[3], 1e-6);
}

// One reading far inside its bound amid known ones: what they let expect, by the dense covariance.
TEST(CensoredDraws, FollowWhatNeighboursLetExpect) {
  constexpr Index n = 7;
  const Line line(n, 1, 1);
  const Field field(line.sites);
  const Covariance c{Family::exponential, {std::log(9.0), std::log(3.0), std::log(1.0), 0}};
  const Whitener whitener(field, c);
  const Eigen::MatrixXd w = whitener(Eigen::MatrixXd::Identity(n, n)), precision = w.transpose() * w;
  Eigen::VectorXd readings(n);
  readings << 3, 4, 5, 40, 3, 2, 4;
  Bounds bounds{std::vector<Known>(n, Known::value), 0};
  bounds.known[3] = Known::below;
  const Moments got = moments_of({readings, bounds, line.rows, field, whitener}, readings);
  double expected = 0;
  for (Index j = 0; j < n; ++j) expected -= j == 3 ? 0 : precision(3, j) * readings[j] / precision(3, 3);
  EXPECT_GT(expected, 2);
  EXPECT_NEAR(got.mean[3], expected, 0.1);
  EXPECT_NEAR(got.sd[3], 1 / std::sqrt(precision(3, 3)), 0.05);
}

// Two readings at a place share its level, and differ by their own scatter: the same as two rows there.
TEST(CensoredDraws, OfOneRowOrOfTwoAreTheSame) {
  const Covariance c{Family::exponential, {std::log(9.0), std::log(3.0), std::log(2.0), 0}};
  const Eigen::VectorXd readings = Eigen::Vector4d(-3, 2, 1, -1);
  const Bounds bounds{{Known::below, Known::value, Known::value, Known::below}, 0};
  const Line together(2, 2, 2);
  Line apart(4, 1, 0);
  apart.sites.place.row(0) << 0, 0, 2, 2;
  const Field of_two(together.sites), of_four(apart.sites);
  const Whitener two(of_two, c), four(of_four, c);
  const Moments one = moments_of({readings, bounds, together.rows, of_two, two}, readings),
                other = moments_of({readings, bounds, apart.rows, of_four, four}, readings);
  EXPECT_LT((one.mean - other.mean).cwiseAbs().maxCoeff(), 0.12);
  EXPECT_LT((one.sd - other.sd).cwiseAbs().maxCoeff(), 0.08);
  EXPECT_GT(one.sd[0], 0.5);
}

// Six of ten readings below a floor: their expectations leave half of the scatter, draws all of it. A field that is
// long beside the places without a known reading moves slowly from draw to draw.
TEST(CensoredDraws, LeaveTheNoiseAsWideAsItIs) {
  for (const double decorrelation : {1.8, 5.0}) {
    SCOPED_TRACE(decorrelation);
    synthetic::Recipe recipe;
    recipe.seed = 5;
    recipe.readings = 3000;
    recipe.sigma = 3;
    recipe.decorrelation = decorrelation;
    recipe.fading = 3;
    synthetic::World world = synthetic::world_of(recipe);
    Eigen::VectorXd sorted = world.rssi;
    std::sort(sorted.begin(), sorted.end());
    const double floor = std::round(sorted[1800]);
    world.rssi = world.rssi.cwiseMax(floor).eval();
    inference::Problem problem = synthetic::problem_of(world, Eigen::VectorXd::Zero(3000), {}, {.way = -1});
    problem.bounds.half_code = 0.5;
    for (Index i = 0; i < 3000; ++i)
      problem.bounds.known.push_back(problem.measured[i] <= floor ? Known::below : Known::value);
    const inference::ModelState state(problem, {});
    const Covariance& c = state.fit.covariance;
    EXPECT_NEAR(std::sqrt(c.field_variance()), 3, 0.6);
    EXPECT_NEAR(std::sqrt(c.reading_variance()), 3, 0.5);
    for (Index i = 0; i < 3000; ++i) {  // each draw keeps to its bound
      if (problem.measured[i] <= floor) {
        EXPECT_LE(state.measured()[i], floor + 0.5 + 1e-9) << i;
      } else {
        EXPECT_EQ(state.measured()[i], problem.measured[i]) << i;
      }
    }
  }
}

// Twice the log likelihood of the known readings and the bounds in white noise, at its highest (Tobit: Tobin 1958).
double tobit(const Eigen::VectorXd& readings, const Bounds& bounds, const Eigen::MatrixXd& design, double sd) {
  Eigen::VectorXd coefficients = Eigen::VectorXd::Zero(design.cols());
  double value = 0;
  for (int step = 0; step < 60; ++step) {
    const Eigen::VectorXd mean = design * coefficients;
    Eigen::VectorXd slope(mean.size()), bend(mean.size());
    value = 0;
    for (Index i = 0; i < mean.size(); ++i) {
      const auto k = static_cast<std::size_t>(i);
      if (bounds.is_bound(k)) {
        const double z = (mean[i] - bounds.highest(k, readings[i])) / sd, pull = hazard(z);
        value += 2 * std::log(above(z));
        slope[i] = -pull / sd;
        bend[i] = pull * (pull - z) / (sd * sd);
      } else {
        const double off = (readings[i] - mean[i]) / sd;
        value -= off * off;
        slope[i] = off / sd;
        bend[i] = 1 / (sd * sd);
      }
    }
    const Eigen::MatrixXd information = design.transpose() * bend.asDiagonal() * design;
    coefficients += information.ldlt().solve(design.transpose() * slope);
  }
  return value;
}

// White noise, and a loss in half of the readings. Most of these are lost: for their level, or by chance, where the
// bound tells nothing. Gains are of the loss's column, summed over `worlds`.
struct Gains {
  double exact = 0, nearer = 0,
         without = 0;  // the censored likelihood's; beside draws nearer to the loss, and without it
};

Gains gains_of_a_loss(double loss, bool by_chance, uint64_t worlds) {
  constexpr Index count = 800;
  Gains sum;
  for (uint64_t seed = 1; seed <= worlds; ++seed) {
    synthetic::Recipe recipe;
    recipe.seed = seed;
    recipe.readings = count;
    recipe.sigma = 0.01;
    recipe.fading = 4;
    const synthetic::World world = synthetic::world_of(recipe);
    const Stream random(seed);
    Eigen::VectorXd lossy(count);
    for (Index i = 0; i < count; ++i) lossy[i] = random.uniform(static_cast<uint64_t>(i)) < 0.5;
    inference::Problem problem = synthetic::problem_of(world, -loss * lossy, {}, {.way = -1});
    Eigen::VectorXd sorted = problem.measured;
    std::sort(sorted.begin(), sorted.end());
    const double floor = std::round(sorted[count * 6 / 10]), anything = 300;  // dBm
    for (Index i = 0; i < count; ++i) {
      const bool lost = by_chance ? random.uniform(static_cast<uint64_t>(count + i)) < 0.3 + 0.5 * lossy[i]
                                  : problem.measured[i] <= floor;
      if (lost) problem.measured[i] = by_chance ? anything : floor;
      problem.bounds.known.push_back(lost ? Known::below : Known::value);
    }
    inference::ModelState state(problem, {});
    const Eigen::MatrixXd column = state.rows().mean(lossy);
    const auto gain = [&] { return state.whitened_model(state.design()).gain(column); };
    sum.without += gain();
    const inference::ModelState::Draws before = state.draws();
    state.draw_towards(column);
    sum.nearer += gain();
    state.put_back(before);
    EXPECT_EQ(state.measured(), before.measured);
    Eigen::MatrixXd both(count, problem.base.cols() + 1);
    both << problem.base, lossy;
    const double sd = std::sqrt(state.fit.covariance.reading_variance() + state.fit.covariance.field_variance());
    sum.exact +=
        tobit(problem.measured, problem.bounds, both, sd) - tobit(problem.measured, problem.bounds, problem.base, sd);
  }
  return sum;
}

// Draws nearer to a lead grant it most of what the censored likelihood does, and never more; those of the model without
// it hide half of that.
TEST(CensoredDraws, NearerToALeadGrantItItsGain) {
  for (const bool by_chance : {false, true}) {
    const Gains large = gains_of_a_loss(5, by_chance, 2);
    EXPECT_GT(large.nearer, 0.6 * large.exact) << by_chance;
    EXPECT_LT(large.nearer, 1.05 * large.exact) << by_chance;
    EXPECT_LT(large.without, 0.75 * large.nearer) << by_chance;
    const Gains none = gains_of_a_loss(0, by_chance, 3);
    EXPECT_LT(none.nearer, none.exact + 10) << by_chance;
  }
}

}  // namespace
}  // namespace muster::noise
