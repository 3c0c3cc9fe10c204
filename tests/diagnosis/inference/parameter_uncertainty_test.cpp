// Uncertainty of a place, and the middle of its likely thetas.
#include "diagnosis/inference/assess/parameter_uncertainty.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "diagnosis/inference/assess/coefficient_covariance.hpp"
#include "diagnosis/inference/noise/exact_covariance.hpp"
#include "diagnosis/inference/score/conditional_fit.hpp"
#include "tests/diagnosis/inference/guessed.hpp"

namespace muster::inference {
namespace {

TEST(ParameterUncertainty, MiddleExplainsAsMuchAsTheBestFit) {
  const auto world = world_of(varied(12, 4000));
  const auto causes = causes_of(world);
  const Candidate& wall = causes[causes.size() - 2];
  const Eigen::Vector4d place(12, 8, 4, 0), east(1, 0, 0, 0);
  const Problem problem = problem_of(world, -scaled_to(world, wall.design.columns(place), 300), causes);
  ModelState state(problem, {});
  const auto middle = [&](const Eigen::Vector4d& found, const std::vector<double>& alike) {
    state.terms = {term_at(state, "unmapped_wall", found)};
    state.refit();
    ParameterUncertainty spread;
    for (const double off : alike) spread.thetas.push_back(place + off * east);
    return middle_of(state, state.terms[0], spread)[0] - place[0];
  };
  EXPECT_NEAR(middle(place + east, {-1, -0.8, -0.6, -0.4, -0.2, 0, 0.2, 0.4, 0.6, 0.8, 1}), 0, 0.7);
  EXPECT_NEAR(middle(place, {0, -0.001, -4, -7.999, -8}), 0, 0.1);  // a theta between two places explains nothing
}

// Compares with the sum over a grid of places and sizes.
TEST(ParameterUncertainty, OfAnObstacleMatchesIntegrationOverAGrid) {
  const auto world = world_of(varied(12, 4000));
  const auto causes = causes_of(world);
  const Candidate& thing = causes.back();
  const Eigen::Vector3d truth(11, 7, 0.7);
  const Problem problem = problem_of(world, -scaled_to(world, thing.design.columns(truth), 60), causes);
  ModelState state(problem, {});
  state.terms = {term_at(state, "obstacle", truth)};
  state.refit();
  score(state);
  const Term& term = state.terms[0];
  const ParameterUncertainty spread = parameter_uncertainty(state, term);
  const WhitenedModel rest = state.whitened_model(state.design_without(term)),
                      whole = state.whitened_model(state.design());
  const Index last = whole.design.cols() - 1;
  const double overstated = std::max(1.0, coefficient_covariance(state, state.design())(last, last) /
                                              whole.at.basis.uncertainty(last + 1)(last, last));
  const ConditionalFit found(rest, term.columns, false);
  auto still = std::make_shared<Candidate>(*term.candidate);
  still->refinement.step.setZero();
  std::shared_ptr<const Candidate> known = still;
  std::swap(state.terms[0].candidate, known);
  const double grown = parameter_uncertainty(state, term).coefficients(0, 0) / found.covariance(0, 0);
  std::swap(state.terms[0].candidate, known);
  Eigen::Array3d sum = Eigen::Array3d::Zero(), squares = sum;
  double weights = 0, within = 0, losses = 0, loss_squares = 0;
  const double top = rest.gain(term.columns);
  for (double x = -0.24; x <= 0.24; x += 0.02) {
    for (double y = -0.1; y <= 0.38; y += 0.02) {
      for (double radius = -0.2; radius <= 0.12; radius += 0.016) {
        const Eigen::Vector3d theta = truth + Eigen::Vector3d(x, y, radius);
        const ConditionalFit there(rest, state.columns_of(*term.candidate, theta), false);
        if (there.gain < top - 40) continue;  // a disk that no link crosses has no loss
        const double w = std::exp((there.gain - top) / (2 * overstated)), loss = there.coefficients[0];
        const Eigen::Array3d off = theta - truth;
        weights += w, sum += w * off, squares += w * off.square();
        within += w * there.covariance(0, 0), losses += w * loss, loss_squares += w * loss * loss;
      }
    }
  }
  const Eigen::Array3d mean = sum / weights, sd = (squares / weights - mean.square()).sqrt();
  Eigen::Array3d told = Eigen::Array3d::Zero(), scattered = told;
  const auto count = static_cast<double>(spread.thetas.size());
  for (const auto& theta : spread.thetas) told += (theta - truth).array() / count;
  for (const auto& theta : spread.thetas) scattered += ((theta - truth).array() - told).square() / count;
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(told[k], mean[k], 0.25 * sd[k]) << k;
    EXPECT_NEAR(std::sqrt(scattered[k]) / sd[k], 1, 0.15) << k;
  }
  const double loss = found.coefficients[0];  // the reported one, for any mean
  const double between = loss_squares / weights - 2 * loss * losses / weights + loss * loss;
  EXPECT_NEAR(spread.coefficients(0, 0) / (grown * within / weights + between), 1, 0.15);
}

// The exact covariance of rows, and the matrix that takes them to Vecchia's estimates.
struct LinearFit {
  explicit LinearFit(const ModelState& state) : design(state.design()), model(state.whitened_model(design)) {
    const Index rows = state.rows().size();
    const Eigen::MatrixXd unit = Eigen::MatrixXd::Identity(rows, rows),
                          told = model.at.basis.q.transpose() * model.whitener(unit);
    covariance = noise::covariance_of_sums(state.field(), state.fit.covariance, unit);
    fitted.resize(design.cols(), rows);
    for (Index i = 0; i < rows; ++i) fitted.col(i) = model.at.basis.coefficients(told.col(i), design.cols());
  }

  Eigen::MatrixXd design;
  WhitenedModel model;
  Eigen::MatrixXd covariance, fitted;
};

// Exact variance of estimates from Vecchia's approximation.
TEST(CoefficientCovariance, IsTheScatterUnderTheExactCovariance) {
  const auto world = world_of(varied(5, 1500));
  const Problem problem = problem_of(world, Eigen::VectorXd::Zero(1500), {});
  ModelState state(problem, {});
  const LinearFit fit(state);
  const Eigen::MatrixXd scatter = fit.fitted * fit.covariance * fit.fitted.transpose();
  const Eigen::MatrixXd with_noise = coefficient_covariance(state, fit.design);
  state.fit.curvature *= 1e12;  // no uncertainty of the noise
  const Eigen::MatrixXd known = coefficient_covariance(state, fit.design);
  EXPECT_LT((known - scatter).norm(), 1e-4 * scatter.norm());
  EXPECT_GT(with_noise(0, 0), 1.002 * known(0, 0));
}

// A fit leaves less than the noise: what is left scatters by the exact covariance of y - X b.
TEST(TakenUpByFit, IsWhatTheResidualsLackOfTheNoise) {
  const auto world = world_of(varied(5, 1500));
  const Problem problem = problem_of(world, Eigen::VectorXd::Zero(1500), {});
  ModelState state(problem, {});
  const LinearFit fit(state);
  const Index rows = state.rows().size();
  const Eigen::MatrixXd left = Eigen::MatrixXd::Identity(rows, rows) - fit.design * fit.fitted;
  const Eigen::VectorXd whole = fit.covariance.diagonal(),
                        residual = (left * fit.covariance * left.transpose()).diagonal(),
                        weight = state.rows().count() / state.rows().count().sum();
  const double taken = taken_up_by_fit(state, fit.design, fit.model);
  EXPECT_GT(taken, 0.02 * weight.dot(whole));  // else nothing is tested
  EXPECT_NEAR(taken, weight.dot(whole - residual), 0.05 * taken);
}

}  // namespace
}  // namespace muster::inference
