// Null tails, effective numbers of tests, atoms and sparse columns against closed forms.
#include "diagnosis/inference/score/candidate_scores.hpp"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>
#include <vector>

#include "diagnosis/inference/score/sparse_columns.hpp"
#include "diagnosis/inference/state/null_tail.hpp"
#include "muster/random.hpp"
#include "tests/diagnosis/inference/causes.hpp"

namespace muster::inference {
namespace {

using synthetic::causes_of;
using synthetic::problem_of;
using synthetic::varied;
using synthetic::world_of;

TEST(LogTail, IsExactForOneAndTwoDegreesOfFreedom) {
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

TEST(LogEffectiveTests, CountsIndependentAtomsAndOneOfEqualAtoms) {
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

// Beside an atom that weighs a million times as much, one of which all is left counts, and one of which the model has
// left nothing but rounding does not.
TEST(OrthonormalAtoms, CountBesideMuchHeavierOnes) {
  noise::Sheet columns = normals(200, 3, 13);
  columns.col(0) *= 1000;
  columns.col(2) *= 1e-3f;
  const Eigen::Vector3f before(columns.col(0).squaredNorm(), columns.col(1).squaredNorm(), 200);
  const noise::Sheet x = columns;
  const Eigen::MatrixXf along = OrthonormalAtoms(columns, 1, before).along(x);
  EXPECT_GT(along(1, 1), 10);
  EXPECT_EQ(along(2, 2), 0);
  EXPECT_EQ(OrthonormalAtoms(columns, 1).along(x)(1, 1), 0);  // of places: too few readings tell of it
}

// Adding row by row equals taking the whole column.
TEST(SparseColumns, GainEqualsThatOfTheDenseColumn) {
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

TEST(GainOf, IsZeroWhereTheBestStrengthHasTheOtherSign) {
  const auto world = world_of(varied(5, 900));
  const Problem problem = problem_of(world, Eigen::VectorXd::Zero(900), causes_of(world));
  const ModelState state(problem, {});
  const WhitenedModel model = state.whitened_model(state.design());
  const Eigen::MatrixXd column = normals(state.rows().size(), 1, 31).cast<double>();
  Candidate c;
  EXPECT_EQ(gain_of(c, model, column), model.gain(column));
  double both = 0;
  for (const int sign : {-1, 1}) {
    c.design.sign = sign;
    EXPECT_NEAR(gain_of(c, model, column), gain_of(c, model, 3 * column), 1e-9);
    both += gain_of(c, model, column);
    EXPECT_EQ(std::min(gain_of(c, model, column), gain_of(c, model, -column)), 0);
  }
  EXPECT_NEAR(both, model.gain(column), 1e-9);
}

TEST(SkewCharge, IsTheLogRatioOfTheSkewedToTheNormalTail) {
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

// Fades that both directions of a link share are skewed; half their differences are not.
TEST(SkewCharge, OfRowsAloneIsTheirOwn) {
  const auto world = world_of(varied(7, 2000));
  const auto causes = causes_of(world);
  const ModelState state(problem_of(world, Eigen::VectorXd::Zero(world.rssi.size()), causes), {});
  WhitenedModel model = state.whitened_model(state.base());
  const Index rows = state.rows().size();
  const Stream stream(key_of("skewed"));
  Eigen::VectorXd column = Eigen::VectorXd::Zero(rows);
  for (Index i = 0; i < rows; ++i) {
    const auto k = static_cast<uint64_t>(i);
    const bool alone = i >= rows / 2;
    column[i] = i >= rows - 60;
    model.alone.push_back(alone);
    model.at.residual[i] = alone ? stream.normal(k) : std::log(stream.uniform(k) + 1e-9) + 1;
  }
  const Eigen::VectorXd late = model.at.basis.rest(model.whitener(column));
  model.at.residual -= late * (late.dot(model.at.residual) + 6 * late.norm()) / late.squaredNorm();  // z of -6
  EXPECT_LT(model.skew_charge(column), 0.3);
  model.alone.clear();
  EXPECT_GT(model.skew_charge(column), 1);
}

}  // namespace
}  // namespace muster::inference
