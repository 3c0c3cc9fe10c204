// Parts of the search against closed forms: tails, effective tests, successive halving, refinement, folds.
#include <gtest/gtest.h>

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "diagnosis/inference/assess/coefficient_covariance.hpp"
#include "diagnosis/inference/assess/parameter_uncertainty.hpp"
#include "diagnosis/inference/noise/exact_covariance.hpp"
#include "diagnosis/inference/score/importance_weights.hpp"
#include "diagnosis/inference/score/refine.hpp"
#include "diagnosis/inference/score/refinement_null.hpp"
#include "diagnosis/inference/score/sparse_columns.hpp"
#include "diagnosis/inference/score/student_mixture.hpp"
#include "diagnosis/inference/select/backward_elimination.hpp"
#include "diagnosis/inference/select/choose.hpp"
#include "diagnosis/inference/select/merge_duplicates.hpp"
#include "diagnosis/inference/state/null_tail.hpp"
#include "muster/random.hpp"
#include "tests/diagnosis/inference/causes.hpp"

namespace muster::inference {
namespace {

using synthetic::causes_of;
using synthetic::problem_of;
using synthetic::varied;
using synthetic::world_of;

TEST(LogTail, IsExactForTwoDegreesAndForOne) {
  for (const double gain : {0.1, 5.0, 60.0, 900.0, 5000.0}) EXPECT_NEAR(log_tail(gain, 2), -gain / 2, 1e-9 * gain);
  for (const double gain : {0.5, 9.0, 400.0})
    EXPECT_NEAR(log_tail(gain, 1), std::log(std::erfc(std::sqrt(gain / 2))), 1e-8);
  EXPECT_NEAR(log_tail(800.01, 14), log_tail(799.99, 14) - 0.01, 1e-3);  // beyond the switch to the series
  EXPECT_EQ(log_tail(0, 3), 0);
}

noise::Sheet normals(Index rows, Index columns, uint64_t seed) {
  noise::Sheet result(rows, columns);
  for (Index i = 0; i < rows; ++i) {
    for (Index j = 0; j < columns; ++j)
      result(i, j) = static_cast<float>(Stream(seed).normal(static_cast<uint64_t>(i), static_cast<uint64_t>(j)));
  }
  return result;
}

TEST(LogEffective, IsTheNumberOfAtomsThatAreIndependentAndOneOfEqualAtoms) {
  const noise::Sheet nulls = normals(400, 4000, 3);
  Candidate c;
  for (const int width : {1, 2}) {
    c.design.width = width;
    const OrthonormalAtoms apart(noise::Sheet::Identity(400, 60 * width), width);
    EXPECT_NEAR(log_effective_tests(c, apart, nulls), std::log(60), 0.15) << width;
  }
  c.design.width = 1;
  noise::Sheet same = noise::Sheet::Zero(400, 60);
  same.row(0).setOnes();
  const OrthonormalAtoms equal(same, 1);
  EXPECT_NEAR(log_effective_tests(c, equal, nulls), 0, 0.1);
  c.design.sign = -1;
  EXPECT_NEAR(log_effective_tests(c, equal, nulls), 0, 0.1);
}

// Compares with a decomposition of each atom, one with a redundant column.
TEST(OrthonormalAtoms, HaveTheProjectionsOfTheirAtoms) {
  constexpr Index width = 3, atoms = 5;
  noise::Sheet columns = normals(200, width * atoms, 11);
  columns.col(5) = columns.col(4) - 0.5f * columns.col(3);
  columns.col(7) += 20 * columns.col(6);
  const noise::Sheet x = normals(200, 4, 12);
  const Eigen::MatrixXf along = OrthonormalAtoms(columns, width).along(x);
  for (Index k = 0; k < atoms; ++k) {
    const Eigen::MatrixXd atom = columns.middleCols(k * width, k == 1 ? 2 : width).cast<double>();
    const Eigen::MatrixXd explained = atom * atom.colPivHouseholderQr().solve(x.cast<double>());
    for (Index j = 0; j < x.cols(); ++j) {
      const double energy = explained.col(j).squaredNorm();
      EXPECT_NEAR(along.col(j).segment(k * width, width).squaredNorm(), energy, 1e-3 * energy) << k;
    }
  }
}

TEST(Climbed, FindsTheTopInsideItsBoundsAndLeavesFixedEntriesAlone) {
  Candidate c;
  c.refinement.lower = Eigen::Vector3d(-5, 0, -5);
  c.refinement.upper = Eigen::Vector3d(5, 9, 2);
  c.refinement.step = Eigen::Vector3d(0.5, 0, 0.5);
  const auto [theta, value] = local_search(c, Eigen::Vector3d(3, 7, -3), 400, [](const Eigen::VectorXd& t) {
    return 10 - std::pow(t[0] - 1, 2) - std::pow(t[2] - 4, 2) - std::pow(t[1] - 2, 2);
  });
  EXPECT_NEAR(theta[0], 1, 0.05);
  EXPECT_EQ(theta[1], 7);
  EXPECT_NEAR(theta[2], 2, 0.02);
  EXPECT_NEAR(value, 10 - 25 - 4, 0.1);
}

TEST(Climbed, HandsOnWhatACandidateThrows) {
  Candidate c;
  c.refinement.lower = c.refinement.step = Eigen::VectorXd::Ones(1);
  c.refinement.upper = Eigen::VectorXd::Constant(1, 9);
  int calls = 0;
  const auto value = [&](const Eigen::VectorXd&) -> double {
    if (++calls > 3) throw std::runtime_error("no such place");
    return calls;
  };
  EXPECT_THROW(local_search(c, Eigen::VectorXd::Constant(1, 2), 50, value), std::runtime_error);
}

// Optima of heights 1, 2, 4 and 3 at 1, 3, 5 and 7, and the number of evaluations near each.
struct Tops {
  std::array<int, 4> looked = {};

  double operator()(const Eigen::VectorXd& theta) {
    constexpr std::array heights{1, 2, 4, 3};
    const auto nearest = static_cast<std::size_t>(std::clamp(std::lround((theta[0] - 1) / 2), 0l, 3l));
    ++looked[nearest];
    return heights[nearest] - std::abs(theta[0] - 1 - 2 * static_cast<double>(nearest));
  }
};

Candidate along_a_line() {
  Candidate c;
  c.refinement.lower = Eigen::VectorXd::Zero(1);
  c.refinement.upper = Eigen::VectorXd::Constant(1, 8);
  c.refinement.step = Eigen::VectorXd::Constant(1, 0.1);
  c.refinement.evaluations = 30;
  return c;
}

std::vector<Eigen::VectorXd> starting_at(const std::vector<double>& places) {
  std::vector<Eigen::VectorXd> result;
  result.reserve(places.size());
  for (const double place : places) result.push_back(Eigen::VectorXd::Constant(1, place));
  return result;
}

TEST(Raced, TheBetterHalfGoesOnWithTwiceAsManyEvaluations) {
  std::array<Tops, 3> laps;
  const Optimum top = successive_halving(along_a_line(), starting_at({1.1, 3.1, 5.1, 7.1}),
                                         {std::ref(laps[0]), std::ref(laps[1]), std::ref(laps[2])});
  EXPECT_EQ(laps[0].looked, (std::array{11, 11, 11, 11}));
  EXPECT_EQ(laps[1].looked, (std::array{0, 0, 21, 21}));
  EXPECT_EQ(laps[2].looked, (std::array{0, 0, 41, 0}));
  EXPECT_NEAR(top.first[0], 5, 0.05);
  EXPECT_NEAR(top.second, 4, 0.05);
}

TEST(Raced, TwoThatMeetGoOnAsOne) {
  std::array<Tops, 2> laps;
  successive_halving(along_a_line(), starting_at({4.99, 5.01, 1, 3}), {std::ref(laps[0]), std::ref(laps[1])});
  EXPECT_EQ(laps[0].looked, (std::array{11, 11, 22, 0}));
  EXPECT_EQ(laps[1].looked, (std::array{0, 0, 21, 0}));
}

// A sketch may show an object where there is none: the final choice uses all readings.
TEST(Refined, KeepsAPlaceThatOneReadingARowLedAwayFrom) {
  const auto world = world_of(varied(12, 4000));
  std::vector<Candidate> causes = causes_of(world);
  Candidate& thing = causes.back();
  const Eigen::Vector3d at(11, 7, 0.7), elsewhere(20, 12, 0.7);
  const Problem plain = problem_of(world, -scaled_to(world, thing.design.columns(at), 100), causes);
  const noise::Rows rows = plain.layout->rows();
  const auto columns = thing.design.columns;
  thing.refinement.proposed = [&](Tally&) { return std::vector<Eigen::VectorXd>{at, elsewhere}; };
  thing.design.sketch = [&, columns](const Eigen::VectorXd& theta) {
    return rows.mean(columns(theta + at - elsewhere));
  };
  Problem problem = plain;
  problem.candidates = causes;
  ModelState state(problem, {});
  const WhitenedModel model = state.whitened_model(state.design());
  for (const ScoredCandidate& lead : scored_candidates(state, model)) {
    if (lead.candidate().id != "obstacle") continue;
    const ScoredCandidate best = refined(state, model, lead, false);
    EXPECT_GE(best.gain, model.gain(state.columns_of(lead.candidate(), at)) - 1e-9);
    EXPECT_LT((best.theta - at).head<2>().norm(), 0.5) << best.theta.transpose();
  }
}

// A chirp has two functions and a grid, a bend one function and a grid: each costs twice its gain by chance.
TEST(Compared, AColumnThatWasObservedComesBeforeTimeWhereItDoesAsWellForItsNumberOfFunctions) {
  const auto world = world_of(varied(5, 900));
  const Problem problem = problem_of(world, Eigen::VectorXd::Zero(900), {});
  ModelState state(problem, {});
  const WhitenedModel model = state.whitened_model(state.design());
  std::vector<ScoredCandidate> all = scored_candidates(state, model);
  const auto lead_of = [&](const std::string& id) -> ScoredCandidate& {
    return *std::find_if(all.begin(), all.end(),
                         [&](const ScoredCandidate& lead) { return lead.candidate().id == id; });
  };
  ScoredCandidate swing = lead_of("chirp~time"), bend = lead_of("bend~battery");
  swing.gain = 60, swing.evidence = 20, bend.evidence = 19;
  for (const double more : {-0.1, 0.1}) {
    bend.gain = 60 - 2 * (2 + 1) + 2 * (1 + 1) + more;
    const auto pool = compared(state, model, {swing, bend}, {}, [](const Candidate&) { return true; });
    EXPECT_EQ(pool[0].candidate().id, more > 0 ? "bend~battery" : "chirp~time");
  }
  // A column's own smooth has no grid.
  ScoredCandidate smooth = lead_of("~temperature");
  smooth.evidence = 19;
  for (const double more : {-0.1, 0.1}) {
    smooth.gain = 60 - 2 * (2 + 1) + 2 * static_cast<double>(smooth.columns.cols()) + more;
    const auto pool = compared(state, model, {swing, smooth}, {}, [](const Candidate&) { return true; });
    EXPECT_EQ(pool[0].candidate().id, more > 0 ? "~temperature" : "chirp~time");
  }
}

// Importance sampling from one mixture for another yields the other's mass and mean.
TEST(StudentMixture, DrawsWhatItsDensitySays) {
  Eigen::Matrix3d scale = Eigen::Matrix3d::Zero();
  scale(0, 0) = 1, scale(2, 2) = 0.5, scale(0, 2) = scale(2, 0) = 0.4;
  const StudentMixture one({Eigen::Vector3d(0, 7, 0)}, 3 * scale);
  const StudentMixture other({Eigen::Vector3d(-1, 7, 0.5), Eigen::Vector3d(1.4, 7, 0.5)}, scale);
  constexpr int count = 20000;
  const Stream stream(key_of("mixture"));
  double mass = 0;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (int k = 0; k < count; ++k) {
    const Eigen::VectorXd drawn = one.draw(stream, static_cast<uint64_t>(k));
    ASSERT_EQ(drawn[1], 7);
    const double weight = other.density(drawn) / one.density(drawn) / count;
    mass += weight, mean += weight * drawn;
  }
  EXPECT_NEAR(mass, 1, 0.03);
  EXPECT_NEAR(mean[0] / mass, 0.2, 0.04);
  EXPECT_NEAR(mean[2] / mass, 0.5, 0.03);
}

TEST(Weights, AreWorthAsManyAsHaveThem) {
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(300);
  weights.segment(20, 80).setConstant(0.25);
  EXPECT_NEAR(effective_sample_size(weights), 80, 1e-9);
  EXPECT_EQ(tempered(weights), weights / weights.sum()) << "worth enough";
}

// A normal distribution sampled from a much wider one: its variance doubles with each root.
TEST(Weights, ErrToTheWideSideWhereFewHaveAll) {
  const Eigen::ArrayXd at = Eigen::ArrayXd::LinSpaced(1001, -50, 50);
  const Eigen::VectorXd weights = (-at.square() / 2 / 0.25).exp();
  EXPECT_LT(effective_sample_size(weights), 20);
  const Eigen::VectorXd soft = tempered(weights);
  EXPECT_NEAR(soft.sum(), 1, 1e-12);
  EXPECT_GE(effective_sample_size(soft), 40);
  EXPECT_NEAR(soft.dot((at * at).matrix()), 0.25 * 8, 1e-6);
  const Eigen::VectorXd one = Eigen::VectorXd::Unit(300, 7);
  EXPECT_EQ(tempered(one), one) << "nothing else has any";
}

TEST(Weights, DrawEachAsOftenAsTheyAsk) {
  const Eigen::Vector4d weights(0.5, 0, 0.1, 0.4);
  const std::vector<std::size_t> drawn = resampled(weights, 50);
  ASSERT_EQ(drawn.size(), 50u);
  for (std::size_t k = 0; k < 4; ++k) {
    const auto count = static_cast<double>(std::count(drawn.begin(), drawn.end(), k));
    EXPECT_NEAR(count, 50 * weights[static_cast<Index>(k)], 1) << k;
  }
}

// Adding row by row equals taking the whole column.
TEST(SparseColumns, GainsWhatTheWholeColumnGains) {
  const auto world = world_of(varied(5, 900));
  const Problem problem = problem_of(world, Eigen::VectorXd::Zero(900), causes_of(world));
  ModelState state(problem, {});
  const WhitenedModel model = state.whitened_model(state.design());
  SparseColumns thin(state, model);
  const Stream stream(8);
  for (uint64_t k = 0; k < 20; ++k) {
    Eigen::MatrixXd column = Eigen::MatrixXd::Zero(state.rows().size(), 1);
    thin.clear();
    for (uint64_t j = 0; j < 12; ++j) {
      const auto row = static_cast<Index>(stream.uniform(k, 2 * j) * static_cast<double>(column.rows()));
      const double value = stream.normal(k, 2 * j + 1);
      column(row, 0) += value;
      thin.add(row, value);
    }
    const Eigen::VectorXd left = model.at.basis.rest(model.whitener(column));
    EXPECT_NEAR(thin.length(), left.squaredNorm(), 1e-9 * left.squaredNorm());
    EXPECT_NEAR(thin.along(), left.dot(model.at.residual), 1e-9 * left.norm() * model.at.residual.norm());
    EXPECT_NEAR(thin.gain(), thin.along() > 0 ? model.gain(column) : 0, 1e-6);
  }
}

// Information on an object: rows of 2.5 m keep half of the single readings', and seven tenths once split at its
// edges.
TEST(ModelState, RowsThatEndAtTheEdgesOfAThingTellOfIt) {
  const auto world = world_of(varied(12, 4000));
  const auto causes = causes_of(world);
  const Candidate& thing = causes.back();
  const Eigen::Vector3d at(11, 7, 0.7);
  const Eigen::VectorXd effect = -scaled_to(world, thing.design.columns(at), 60);
  const Problem long_rows = problem_of(world, effect, causes, {.time = 5, .way = 2.5}),
                single = problem_of(world, effect, causes, {.way = -1});
  ModelState state(long_rows, {}), readings(single, {});
  const auto told = [&](const ModelState& b) {
    const WhitenedModel model = b.whitened_model(b.design(), readings.fit.covariance);
    return model.at.basis.rest(model.whitener(b.columns_of(thing, at))).squaredNorm();
  };
  ASSERT_LT(3 * state.rows().size(), readings.rows().size());
  const double all = told(readings), before = told(state);
  const Index rows = state.rows().size(), more = state.end_rows_at(thing, at);
  EXPECT_GT(more, 5);
  EXPECT_EQ(state.rows().size(), rows + more);
  EXPECT_LT(before, 0.55 * all);
  EXPECT_GT(told(state), 0.68 * all);
  EXPECT_EQ(state.end_rows_at(thing, at), 0);
  for (const Entry& entry : state.entries()) EXPECT_EQ(entry.atoms->rows(), rows + more);
}

// Exact variance of estimates from Vecchia's approximation.
TEST(Uncertainty, IsTheScatterOfTheCoefficientsUnderTheCovarianceItself) {
  const auto world = world_of(varied(5, 1500));
  const Problem problem = problem_of(world, Eigen::VectorXd::Zero(1500), {});
  ModelState state(problem, {});
  const Eigen::MatrixXd design = state.design();
  const WhitenedModel model = state.whitened_model(design);
  const Index rows = state.rows().size();
  const Eigen::MatrixXd unit = Eigen::MatrixXd::Identity(rows, rows),
                        covariance = noise::covariance_of_sums(state.field().sites(), state.fit.covariance, unit),
                        told = model.at.basis.q.transpose() * model.whitener(unit);
  Eigen::MatrixXd fitted(design.cols(), rows);
  for (Index i = 0; i < rows; ++i) fitted.col(i) = model.at.basis.coefficients(told.col(i), design.cols());
  const Eigen::MatrixXd scatter = fitted * covariance * fitted.transpose();
  const Eigen::MatrixXd with_noise = coefficient_covariance(state, design);
  state.fit.curvature *= 1e12;  // no uncertainty of the noise
  const Eigen::MatrixXd known = coefficient_covariance(state, design);
  EXPECT_LT((known - scatter).norm(), 1e-4 * scatter.norm());
  EXPECT_GT(with_noise(0, 0), 1.002 * known(0, 0));
}

TEST(RefinementCharge, OfAWallIsAFewNatsAndOfAStepLess) {
  const auto world = world_of(varied(16, 3000));
  const Problem problem = problem_of(world, Eigen::VectorXd::Zero(3000), causes_of(world));
  ModelState state(problem, {});
  const double wall = refinement_null(state, "unmapped_wall", 16), step = refinement_null(state, "step", 16);
  RecordProperty("wall", std::to_string(wall));
  RecordProperty("step", std::to_string(step));
  // Of 16 draws: the standard error near the lower quartile is sqrt(0.75 / (16 x 0.25)) = 0.43 nats.
  EXPECT_GT(wall, 0.3);
  EXPECT_LT(wall, 7);
  EXPECT_GT(step, -1.3);
  EXPECT_LT(step, 2.5);
  EXPECT_GT(wall, step + 1);
}

TEST(SkewCharge, IsHowMuchLikelierDeepFadesMakeALoss) {
  // Sums of 40 Rayleigh fades in dB, upside down, against the normal tail.
  const Stream stream(key_of("fades"));
  constexpr int sums = 60000, terms = 40;
  double cubes = 0;
  std::vector<double> z(sums, 0);
  const double sd = 10 / std::log(10.0) * M_PI / std::sqrt(6.0), mean = -10 / std::log(10.0) * 0.5772156649;
  for (uint64_t k = 0; k < sums; ++k) {
    for (uint64_t j = 0; j < terms; ++j) {
      const double x = -(10 * std::log10(-std::log(stream.uniform(k, j) + 1e-300)) - mean) / sd;
      cubes += x * x * x / (sums * terms);
      z[k] += x / std::sqrt(static_cast<double>(terms));
    }
  }
  double beyond = 0;
  for (const double x : z) beyond += x > 2.6 ? 1.0 / sums : 0.0;
  const double normal = 0.5 * std::erfc(2.6 / std::sqrt(2.0));
  EXPECT_NEAR(skew_charge(2.6, cubes / std::sqrt(static_cast<double>(terms))), std::log(beyond / normal), 0.15);
  EXPECT_EQ(skew_charge(6, -0.3), 0);
  EXPECT_NEAR(skew_charge(6, 0), 0, 1e-9);
}

}  // namespace
}  // namespace muster::inference
