// Inflation in the model's own draws: none where they have the fitted covariance, found where a few waves make them.
#include "diagnosis/inference/score/drawn_inflation.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "diagnosis/inference/noise/exact_covariance.hpp"
#include "muster/random.hpp"
#include "tests/diagnosis/inference/causes.hpp"

namespace muster::inference {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using synthetic::causes_of;
using synthetic::problem_of;
using synthetic::varied;
using synthetic::world_of;

using Draws = std::function<MatrixXd(const ModelState&, Index)>;  // of rows

// Inflation of the smooths over the plan, in a state whose model draws like this.
double inflation_in(uint64_t seed, const Draws& draws) {
  const auto world = world_of(varied(seed, 1200));
  const auto causes = causes_of(world);
  Problem problem = problem_of(world, VectorXd::Zero(world.rssi.size()), causes);
  const ModelState* state = nullptr;
  problem.drawn = [&](const noise::StatedField&, Index count) {
    const MatrixXd of_rows = draws(*state, count);
    MatrixXd result(world.rssi.size(), count);
    for (Index k = 0; k < count; ++k) result.col(k) = state->rows().at_readings(of_rows.col(k));
    return result;
  };
  const ModelState at(problem, {});
  state = &at;
  const Candidate* widest = nullptr;  // the candidate with the most atoms
  Index most = 0;
  for (const Entry& entry : at.entries()) {
    if (entry.count() > most) most = entry.count(), widest = entry.candidate.get();
  }
  return drawn_inflation(at, at.whitened_model(at.base()), *widest, at.drawable(at.fit.covariance).back());
}

MatrixXd of_the_covariance(const ModelState& state, Index count) {
  const Index n = state.rows().size();
  const MatrixXd covariance = noise::covariance_of_sums(state.field(), state.fit.covariance, MatrixXd::Identity(n, n));
  const Stream stream(31);
  MatrixXd z(n, count);
  for (Index i = 0; i < n; ++i) {
    for (Index k = 0; k < count; ++k) z(i, k) = stream.normal(static_cast<uint64_t>(i), static_cast<uint64_t>(k));
  }
  return covariance.llt().matrixL() * z;
}

// Three waves over the plan, without any scatter of readings. `amplitude` in dB.
MatrixXd of_few_waves(const ModelState& state, Index count, double amplitude) {
  const Stream stream(32);
  const Eigen::Matrix3Xd& place = state.field().sites().place;
  MatrixXd result = MatrixXd::Zero(place.cols(), count);
  for (Index k = 0; k < count; ++k) {
    for (uint64_t m = 0; m < 3; ++m) {
      const auto draw = static_cast<uint64_t>(k);
      const double turn = 6.283 * stream.uniform(draw, 3 * m), phase = 6.283 * stream.uniform(draw, 3 * m + 1),
                   wave = 0.5 + stream.uniform(draw, 3 * m + 2);
      for (Index i = 0; i < place.cols(); ++i)
        result(i, k) +=
            amplitude * std::cos(wave * (std::cos(turn) * place(0, i) + std::sin(turn) * place(1, i)) + phase);
    }
  }
  return result;
}

MatrixXd of_few_strong_waves(const ModelState& state, Index count) { return of_few_waves(state, count, 20); }
MatrixXd of_few_weak_waves(const ModelState& state, Index count) { return of_few_waves(state, count, 0.3); }

TEST(DrawnInflation, IsOneInDrawsOfTheFittedCovariance) {
  for (uint64_t seed = 1; seed <= 3; ++seed) EXPECT_LT(inflation_in(seed, of_the_covariance), 1.35) << seed;
}

TEST(DrawnInflation, IsFoundInDrawsOfFewWaves) {
  for (uint64_t seed = 1; seed <= 3; ++seed)
    EXPECT_GT(inflation_in(seed, of_few_strong_waves), 1.2 * inflation_in(seed, of_the_covariance)) << seed;
}

// The model scatters its readings less than those of the data, whose scatter hides such waves.
TEST(DrawnInflation, IsOneInDrawsOfWavesThatTheDataCouldNotShow) {
  for (uint64_t seed = 1; seed <= 3; ++seed) EXPECT_LT(inflation_in(seed, of_few_weak_waves), 1.35) << seed;
}

TEST(DrawnInflation, IsOneWhereTheModelDrawsNothing) {
  const auto world = world_of(varied(1, 1200));
  const auto causes = causes_of(world);
  const Problem problem = problem_of(world, VectorXd::Zero(world.rssi.size()), causes);
  const ModelState state(problem, {});
  EXPECT_EQ(drawn_inflation(state, state.whitened_model(state.base()), *state.entries()[0].candidate, {4, 1.8}), 1);
}

// A covariance that fits may be far from that of the draws: what the world states is asked first.
TEST(DrawnInflation, AsksForTheStatedFieldAndTheFittedOneOnceEach) {
  const auto world = world_of(varied(1, 1200));
  Problem problem = problem_of(world, VectorXd::Zero(world.rssi.size()), causes_of(world));
  problem.stated = {40, 0.1};
  std::vector<double> asked;
  problem.drawn = [&](const noise::StatedField& field, Index count) {
    asked.push_back(field.shadowing);
    return MatrixXd::Constant(world.rssi.size(), count, field.shadowing).eval();
  };
  const ModelState state(problem, {});
  const std::vector<noise::StatedField> fields = state.drawable(state.fit.covariance);
  ASSERT_EQ(fields.size(), 2u);
  EXPECT_EQ(fields[0].shadowing, 40);
  for (int again = 0; again < 2; ++again) {
    for (const auto& field : fields) EXPECT_EQ(state.drawn(field)(0, 0), field.shadowing);
  }
  EXPECT_EQ(asked, (std::vector{40, fields[1].shadowing}));
}

// Smooth, and the same for all groups but for a share: unlike the field of the synthetic worlds.
class Smooth : public noise::StatedCorrelation {
 public:
  void covariances(const noise::Sites& sites, double decorrelation, const std::vector<uint32_t>& a,
                   const std::vector<uint32_t>& b, double* out) const override {
    for (std::size_t i = 0; i < a.size(); ++i) {
      const auto one = static_cast<Index>(a[i]), other = static_cast<Index>(b[i]);
      const double apart = (sites.place.col(one) - sites.place.col(other)).norm() / decorrelation;
      out[i] = std::exp(-apart * apart) * (sites.group[a[i]] == sites.group[b[i]] ? 1 : 0.2);
    }
  }
};

// Readings of draws of the stated field, 4 dB over 1.8 m, and 0.5 dB a reading.
MatrixXd of_the_stated_field(const Problem& problem, Index count, uint64_t key) {
  const noise::Rows rows = problem.layout->rows();
  const noise::Field field(problem.layout->sites(rows));
  const noise::Covariance stated{noise::Family::stated, {2 * std::log(4), std::log(1.8), 2 * std::log(0.5), 0}};
  const MatrixXd covariance = noise::covariance_of_sums(field, stated, MatrixXd::Identity(field.size(), field.size()));
  const Stream stream(key);
  MatrixXd z(field.size(), count);
  for (Index i = 0; i < z.rows(); ++i) {
    for (Index k = 0; k < count; ++k) z(i, k) = stream.normal(static_cast<uint64_t>(i), static_cast<uint64_t>(k));
  }
  const MatrixXd drawn = covariance.llt().matrixL() * z;
  MatrixXd readings(problem.measured.size(), count);
  for (Index k = 0; k < count; ++k) readings.col(k) = rows.at_readings(drawn.col(k));
  return readings;
}

TEST(ResemblesDraws, DataOfTheStatedFieldDoAndThoseOfAnotherDoNot) {
  int own = 0;
  for (uint64_t seed = 1; seed <= 4; ++seed) {
    auto recipe = varied(seed, 1200);
    recipe.fading = 0.5;
    const auto world = world_of(recipe);
    Problem problem = problem_of(world, VectorXd::Zero(world.rssi.size()), causes_of(world));
    problem.layout = std::make_shared<const diagnosis::LinkLayout>(
        world.readings, diagnosis::LinkRowLimits{}, std::vector<int>{}, true, std::make_shared<Smooth>());
    problem.drawn = [&](const noise::StatedField&, Index count) { return of_the_stated_field(problem, count, 40); };
    const ModelState of_another(problem, {});
    EXPECT_FALSE(resembles_draws(of_another, of_another.base(), of_another.drawable(of_another.fit.covariance).back()))
        << seed;
    problem.measured = of_the_stated_field(problem, 1, 50 + seed).col(0);
    const ModelState of_its_own(problem, {});
    own += resembles_draws(of_its_own, of_its_own.base(), of_its_own.drawable(of_its_own.fit.covariance).back());
  }
  EXPECT_GE(own, 3);
}

// The data of another field do where no reading scatters by itself, and only there.
TEST(ResemblesDraws, DataThatNothingBlursDo) {
  const auto world = world_of(varied(1, 1200));
  const Stream stream(33);
  for (const double scatter : {0.05, 0.5}) {
    Problem problem = problem_of(world, VectorXd::Zero(world.rssi.size()), causes_of(world));
    problem.layout = std::make_shared<const diagnosis::LinkLayout>(
        world.readings, diagnosis::LinkRowLimits{}, std::vector<int>{}, true, std::make_shared<Smooth>());
    problem.drawn = [&](const noise::StatedField&, Index count) { return of_the_stated_field(problem, count, 40); };
    for (Index i = 0; i < problem.measured.size(); ++i)
      problem.measured[i] = 3 * std::cos(0.8 * world.readings.rx_at(0, i)) + 3 * std::cos(world.readings.rx_at(1, i)) +
                            scatter * stream.normal(static_cast<uint64_t>(i));
    const ModelState state(problem, {});
    EXPECT_EQ(resembles_draws(state, state.base(), state.drawable(state.fit.covariance).back()), scatter < 0.1)
        << scatter << ' ' << state.fit.covariance.reading_variance();
  }
}

}  // namespace
}  // namespace muster::inference
