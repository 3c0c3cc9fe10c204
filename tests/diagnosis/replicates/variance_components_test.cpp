// MINQUE against closed forms, and without bias on draws.
#include "diagnosis/replicates/variance_components.hpp"

#include <gtest/gtest.h>

#include <muster/random.hpp>

namespace muster::diagnosis {
namespace {

Eigen::VectorXd normals(const char* name, uint64_t draw, Eigen::Index count) {
  const Stream stream(combined(key_of(name), draw));
  Eigen::VectorXd result(count);
  for (Eigen::Index i = 0; i < count; ++i) result[i] = stream.normal(static_cast<uint64_t>(i), 0);
  return result;
}

// With one component it is the mean of squares over the shape, whatever the shape.
TEST(VarianceComponents, OfOneIsTheMeanOfStandardisedSquares) {
  const Eigen::Index n = 50;
  const Eigen::VectorXd shape = Eigen::VectorXd::LinSpaced(n, 0.1, 9), z = normals("one", 0, n);
  const Eigen::VectorXd squares = 2.5 * shape.cwiseProduct(z.cwiseAbs2());
  const auto found = variance_components(squares, shape, shape);
  EXPECT_NEAR(found.value[0], 2.5 * z.squaredNorm() / static_cast<double>(n), 1e-12);
  EXPECT_NEAR(found.freedom[0], static_cast<double>(n), 1e-9);
  EXPECT_NEAR(found.stderror[0], found.value[0] * std::sqrt(2 / static_cast<double>(n)), 1e-12);
}

TEST(VarianceComponents, TwoAreToldApartWithoutBias) {
  const Eigen::Index n = 400;
  Eigen::MatrixXd shapes(n, 2);
  shapes << Eigen::VectorXd::LinSpaced(n, 0.1, 3), Eigen::VectorXd::LinSpaced(n, 4, 0.2).cwiseAbs2();
  const Eigen::Vector2d truth(2, 0.7);
  const Eigen::VectorXd variance = shapes * truth;
  constexpr int draws = 400;
  Eigen::MatrixXd found(draws, 2);
  double freedom = 0;
  for (int i = 0; i < draws; ++i) {
    const Eigen::VectorXd z = normals("two", static_cast<uint64_t>(i), n);
    const auto one = variance_components(variance.cwiseProduct(z.cwiseAbs2()), shapes, shapes);
    found.row(i) = one.value;
    freedom += one.freedom[0] / draws;
  }
  for (Eigen::Index k = 0; k < 2; ++k) {
    const double mean = found.col(k).mean(), sd = std::sqrt((found.col(k).array() - mean).square().mean());
    EXPECT_NEAR(mean, truth[k], 4 * sd / std::sqrt(draws)) << k;
    if (k == 1) continue;
    EXPECT_NEAR(sd, truth[k] * std::sqrt(2 / freedom), 0.2 * sd);  // the freedom tells the scatter
  }
}

TEST(VarianceComponents, OneThatIsNotThereIsZeroAndTheOtherWhole) {
  const Eigen::Index n = 200;
  Eigen::MatrixXd shapes(n, 2);
  shapes << Eigen::VectorXd::LinSpaced(n, 1, 2), Eigen::VectorXd::LinSpaced(n, 5, 1);
  // Squares that fall faster than the first component alone can be, and would make the second negative.
  const Eigen::VectorXd squares = shapes.col(0).array().cube() / 4;
  const auto found = variance_components(squares, shapes, shapes);
  EXPECT_EQ(found.value[1], 0);
  EXPECT_EQ(found.freedom[1], 0);
  EXPECT_GT(found.stderror[1], 0);  // up to which it may be there
  const auto alone = variance_components(squares, shapes.col(0), shapes.col(0));
  EXPECT_NEAR(found.value[0], alone.value[0], 1e-9);
}

TEST(VarianceComponents, HeavyTailsTakeFreedom) {
  const Eigen::VectorXd shape = Eigen::VectorXd::Ones(100), squares = normals("tails", 0, 100).cwiseAbs2();
  const double normal = variance_components(squares, shape, shape).freedom[0];
  EXPECT_NEAR(variance_components(squares, shape, shape, 9).freedom[0], normal / 4, 1e-9);
}

}  // namespace
}  // namespace muster::diagnosis
