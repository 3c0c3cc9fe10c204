// Tests of shadowing and blockage on walks with known field and bursts.
#include <gtest/gtest.h>

#include "diagnosis/radio/laws/blockage_test.hpp"
#include "diagnosis/radio/laws/shadowing_test.hpp"
#include "diagnosis/radio/links/link_smooths.hpp"
#include "tests/diagnosis/radio/declared_laws.hpp"
#include "tests/diagnosis/walk.hpp"

namespace muster::diagnosis {
namespace {

inference::Problem problem_of(const Walk& walk) {
  inference::Problem problem;
  problem.layout = std::make_shared<const LinkLayout>(walk.readings, LinkRowLimits());
  problem.smooths = link_smooths(walk.readings, {}, true);
  problem.measured = walk.residual;
  problem.base = Eigen::MatrixXd::Ones(walk.residual.size(), 1);
  return problem;
}

LawTest field_tested(double decorrelation, double stated) {
  const Walk walk = drawn_of_four({.rician_k = 10}, 700, decorrelation);
  const inference::Problem problem = problem_of(walk);
  const inference::ModelState state(problem, {});
  KrigedReadings field(walk.readings, walk.residual);
  return field_test(field, 1, law_of({.rician_k = 10}), {3, stated}, state);
}

TEST(ShadowingTest, NoFalseAlarmForTheStatedField) {
  for (const double decorrelation : {0.8, 1.5, 2.5})
    EXPECT_GT(field_tested(decorrelation, decorrelation).log_p, std::log(0.01)) << decorrelation;
}

TEST(ShadowingTest, MeasuresAnotherDistance) {
  const LawTest test = field_tested(3, 0.7);
  EXPECT_LT(test.log_p, std::log(1e-4));
  EXPECT_NEAR(std::log(test.values[1].value), std::log(3), std::log(1.8));
}

// A prior of indoor shadowing reported a decorrelation of 9 m as 5.
TEST(ShadowingTest, MeasuresAnUnusualDistance) {
  const LawTest test = field_tested(8, 2);
  EXPECT_LT(test.values[1].lower95, 8);
  EXPECT_GT(test.values[1].upper95, 8);
}

Blockage blockage_in(const Walk& walk, const RowMask& asked) {
  const inference::Problem problem = problem_of(walk);
  return blockage_test(inference::ModelState(problem, {}), walk.readings, asked);
}
Blockage blockage_in(const Walk& walk) { return blockage_in(walk, RowMask::Constant(walk.residual.size(), true)); }

TEST(BlockageTest, NoFalseAlarmOnACleanLink) {
  const Walk walk = drawn_of_four({.rician_k = 3}, 600, 1.5);  // deep fades
  EXPECT_GT(blockage_in(walk).test.log_p, std::log(0.01));
}

// Adds dips to the first station's readings, 1.2 s to 1/e each.
void add_bursts(Walk& walk, double first, double every, double dB) {
  for (std::size_t i = 0; i < 600; ++i) {
    const double apart = std::remainder(walk.readings.t[i] - first, every) / 1.2;
    walk.residual[static_cast<Eigen::Index>(i)] += std::round(dB * std::exp(-apart * apart));
  }
}

TEST(BlockageTest, NoFalseAlarmForSymmetricBursts) {
  Walk walk = drawn_of_four({.rician_k = 8}, 600, 1.5);
  add_bursts(walk, 11, 74, -35);
  add_bursts(walk, 48, 74, 35);
  EXPECT_GT(blockage_in(walk).test.log_p, std::log(0.01));
}

// As in a measured flat: dips gain more than twice what rises do, and are still a misfit of the field.
TEST(BlockageTest, NoFalseAlarmForNearlySymmetricBursts) {
  Walk walk = drawn_of_four({.rician_k = 8}, 600, 1.5);
  add_bursts(walk, 11, 74, -35);
  add_bursts(walk, 48, 74, 20);
  EXPECT_GT(blockage_in(walk).test.log_p, std::log(0.01));
}

TEST(BlockageTest, NoFalseAlarmForDeepFadesOfSingleReadings) {
  Walk walk = drawn_of_four({.rician_k = 8}, 600, 1.5);
  for (Eigen::Index i = 20; i < 600; i += 60) walk.residual[i] -= 25;
  EXPECT_GT(blockage_in(walk).test.log_p, std::log(0.01));
}

TEST(BlockageTest, IgnoresExcludedReadings) {
  Walk walk = drawn_of_four({.rician_k = 8}, 600, 1.5);
  const Eigen::VectorXd before = walk.residual;
  add_bursts(walk, 11, 37, -20);
  EXPECT_LT(blockage_in(walk).test.log_p, std::log(1e-6));
  EXPECT_GT(blockage_in(walk, walk.residual.array() == before.array()).test.log_p, std::log(0.01));
  EXPECT_EQ(blockage_in(walk).links, 4u);
  EXPECT_EQ(blockage_in(walk, RowMask::Constant(walk.residual.size(), false)).links, 0u);
}

// A grid over all of the year would need 53 million times for each width.
TEST(BlockageTest, APauseOfAYearChangesNothing) {
  Walk walk = drawn_of_four({.rician_k = 8}, 600, 1.5);
  add_bursts(walk, 11, 37, -20);
  const double near = blockage_in(walk).test.log_p;
  std::vector<double>& t = walk.readings.t;
  const double middle = t[300];
  for (double& at : t) at += at < middle ? 0 : 3.15e7;
  const Blockage found = blockage_in(walk);
  EXPECT_EQ(found.radio, 0);
  EXPECT_NEAR(found.test.log_p / near, 1, 0.5);  // the shuffles of other rows are others
}

TEST(BlockageTest, DetectsAndMeasuresBursts) {
  Walk walk = drawn_of_four({.rician_k = 8}, 600, 1.5);
  add_bursts(walk, 11, 37, -20);
  const Blockage found = blockage_in(walk);
  EXPECT_EQ(found.radio, 0);
  EXPECT_EQ(found.other, 9);
  EXPECT_LT(found.test.log_p, std::log(1e-6));
  for (const LawValue& v : found.test.values) {
    const double truth = v.name == "loss"       ? 12
                         : v.name == "duration" ? 1.2 * std::sqrt(M_PI)
                                                : 1.2 * std::sqrt(M_PI) / 37;
    EXPECT_LT(v.lower95, truth) << v.name;
    EXPECT_GT(v.upper95, truth) << v.name;
  }
}

}  // namespace
}  // namespace muster::diagnosis
