// Importance weights and the mixture that draws come from.
#include "diagnosis/inference/score/importance_weights.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "diagnosis/inference/score/student_mixture.hpp"
#include "muster/random.hpp"

namespace muster::inference {
namespace {

// Importance sampling from one mixture for another yields the other's mass and mean.
TEST(StudentMixture, DrawsFollowTheDensity) {
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

TEST(ImportanceWeights, EffectiveSampleSizeCountsEqualWeights) {
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(300);
  weights.segment(20, 80).setConstant(0.25);
  EXPECT_NEAR(effective_sample_size(weights), 80, 1e-9);
  EXPECT_EQ(tempered(weights), weights / weights.sum()) << "worth enough";
}

// A normal distribution sampled from a much wider one: its variance doubles with each root.
TEST(ImportanceWeights, TemperingWidensWhereFewDrawsHaveAllTheWeight) {
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

TEST(ImportanceWeights, ResamplingIsProportionalToTheWeight) {
  const Eigen::Vector4d weights(0.5, 0, 0.1, 0.4);
  const std::vector<std::size_t> drawn = resampled(weights, 50);
  ASSERT_EQ(drawn.size(), 50u);
  for (std::size_t k = 0; k < 4; ++k) {
    const auto count = static_cast<double>(std::count(drawn.begin(), drawn.end(), k));
    EXPECT_NEAR(count, 50 * weights[static_cast<Eigen::Index>(k)], 1) << k;
  }
}

}  // namespace
}  // namespace muster::inference
