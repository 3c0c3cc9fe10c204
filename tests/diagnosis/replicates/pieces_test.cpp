// Increments of poses do not depend on where a course begins and how it is turned.
#include "diagnosis/replicates/pieces.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace muster::diagnosis {
namespace {

const std::vector<TextColumn> by_yaw = {{"x", "m"}, {"y", "m"}, {"yaw", "rad"}, {"v", "m/s"}};

Eigen::MatrixXd winding(int samples) {
  Eigen::MatrixXd result(samples, 4);
  for (int i = 0; i < samples; ++i) result.row(i) << std::sin(0.3 * i), 0.1 * i, 2.8 + 0.2 * i, 1;
  return result;
}

TEST(Pieces, OfPosesAreInvariantToRigidMotions) {
  const PieceMaker pieces(by_yaw);
  ASSERT_EQ(pieces.kinds().size(), 3u);
  const Eigen::MatrixXd course = winding(12);
  Eigen::MatrixXd moved = course;
  const double angle = 4.4;
  for (Eigen::Index i = 0; i < course.rows(); ++i) {
    moved(i, 0) = 7 + std::cos(angle) * course(i, 0) - std::sin(angle) * course(i, 1);
    moved(i, 1) = -3 + std::sin(angle) * course(i, 0) + std::cos(angle) * course(i, 1);
    moved(i, 2) = std::remainder(course(i, 2) + angle, 2 * std::numbers::pi);
  }
  EXPECT_EQ(pieces(course).size(), 3 * 11);
  EXPECT_LT(pieces.difference(pieces(course), pieces(moved)).cwiseAbs().maxCoeff(), 1e-12);
}

// On a circle the way lies along the direction half way through the turn.
TEST(Pieces, OfAnArcHaveNothingAcross) {
  const PieceMaker pieces(by_yaw);
  Eigen::MatrixXd arc(5, 4);
  for (int i = 0; i < 5; ++i) arc.row(i) << 2 * std::sin(0.4 * i), 2 - 2 * std::cos(0.4 * i), 0.4 * i, 0;
  const Eigen::VectorXd found = pieces(arc);
  for (Eigen::Index i = 0; i < found.size(); i += 3) {
    EXPECT_NEAR(found[i], 4 * std::sin(0.2), 1e-12);  // the chord
    EXPECT_NEAR(found[i + 1], 0, 1e-12);
    EXPECT_NEAR(found[i + 2], 0.4, 1e-12);
  }
}

TEST(Pieces, OfQuaternionsAreThoseOfYaw) {
  const PieceMaker by_turn({{"x", "m"}, {"y", "m"}, {"z", "m"}, {"qw", ""}, {"qx", ""}, {"qy", ""}, {"qz", ""}}),
      by_angle(by_yaw);
  const Eigen::MatrixXd course = winding(9);
  Eigen::MatrixXd turned = Eigen::MatrixXd::Zero(9, 7);
  turned.leftCols(2) = course.leftCols(2);
  turned.col(3) = (course.col(2) / 2).array().cos();
  turned.col(6) = (course.col(2) / 2).array().sin();
  EXPECT_LT(by_turn.difference(by_turn(turned), by_angle(course)).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(Pieces, OfAnythingElseAreTheValues) {
  const PieceMaker pieces({{"range", "m"}, {"bearing", "rad"}});
  Eigen::MatrixXd samples(2, 2);
  samples << 1, 3, 2, -3;
  EXPECT_EQ(pieces(samples), Eigen::Vector4d(1, 3, 2, -3));
  const Eigen::VectorXd apart = pieces.difference(Eigen::Vector4d(1, 3, 2, -3), Eigen::Vector4d(0.5, -3, 2, 3));
  EXPECT_NEAR(apart[0], 0.5, 1e-15);
  EXPECT_NEAR(apart[1], 6 - 2 * std::numbers::pi, 1e-12);  // the shorter way round
  const Eigen::RowVectorXd between = pieces.between(samples.row(0), samples.row(1), 0.5);
  EXPECT_NEAR(between[0], 1.5, 1e-15);
  EXPECT_NEAR(std::abs(between[1]), std::numbers::pi, 1e-12);
}

}  // namespace
}  // namespace muster::diagnosis
