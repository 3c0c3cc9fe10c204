// Figures that a description computes: inertias of shapes, the effective base of a skid steer.
#include <gtest/gtest.h>

#include <cmath>

#include "description/urdf_inertia.hpp"

namespace muster::description {
namespace {

// Against textbook figures, and Steiner's term for two bodies.
TEST(Inertia, OfFilledShapes) {
  const Mass ball = *filled({Shape{Eigen::Isometry3d::Identity(), Sphere{2}}});
  EXPECT_NEAR(ball.mass, 33.510321638291124, 1e-12);
  EXPECT_NEAR(ball.inertia(0, 0), 0.4 * ball.mass * 4, 1e-12);
  const Mass rod = *filled({Shape{Eigen::Isometry3d::Identity(), Cylinder{1, 6}}});
  EXPECT_NEAR(rod.inertia(0, 0), rod.mass * (3 + 36) / 12, 1e-12);
  EXPECT_NEAR(rod.inertia(2, 2), rod.mass / 2, 1e-12);
  const Shape left{Eigen::Isometry3d(Eigen::Translation3d(0, 1, 0)), Box{{1, 1, 1}}};
  const Shape right{Eigen::Isometry3d(Eigen::Translation3d(0, -1, 0)), Box{{1, 1, 1}}};
  EXPECT_NEAR(filled({left, right})->inertia(0, 0), 2.0 / 6 + 2, 1e-12);
  EXPECT_FALSE(filled({}));
  EXPECT_FALSE(filled({left, Shape{Eigen::Isometry3d::Identity(), Mesh{}}}));
}

// The middle wheels of three axles do not slip across, which the moments of the others balance.
TEST(SkidSteer, EffectiveBase) {
  EXPECT_EQ(effective_base(0.5, {0}), 0.5);
  EXPECT_NEAR(effective_base(0.5, {0.2, -0.2}), 0.82, 1e-12);
  const double three = effective_base(0.5, {0.2, 0, -0.2}), v = three / 2, along = v - 0.25;
  EXPECT_NEAR(0.25 + 2 * (along * 0.25 - 0.04) / std::hypot(along, 0.2), 0, 1e-9);
  EXPECT_GT(three, 0.5);
  EXPECT_LT(three, 0.82);
}

}  // namespace
}  // namespace muster::description
