#include <cmath>

#include "description/robot.hpp"

namespace muster::description {

using Eigen::AlignedBox3d;
using Eigen::Isometry3d;
using Eigen::Vector3d;

namespace {

// Half extents of the box along each axis of the frame in which it is placed.
Vector3d reach(const Isometry3d& pose, const Box& box) { return pose.linear().cwiseAbs() * box.size / 2; }
Vector3d reach(const Isometry3d&, const Sphere& sphere) { return Vector3d::Constant(sphere.radius); }
Vector3d reach(const Isometry3d& pose, const Cylinder& cylinder) {
  const Eigen::Array3d axis = pose.linear().col(2).array();
  return cylinder.radius * (1 - axis.square()).max(0).sqrt() + cylinder.length / 2 * axis.abs();
}

template <class Symmetric>
AlignedBox3d bounds_of(const Isometry3d& pose, const Symmetric& shape) {
  const Vector3d far = reach(pose, shape);
  return {pose.translation() - far, pose.translation() + far};
}
AlignedBox3d bounds_of(const Isometry3d& pose, const Mesh& mesh) {
  AlignedBox3d result;
  for (const Vector3d& vertex : mesh.vertices) result.extend(pose * vertex);
  return result;
}

}  // namespace

AlignedBox3d bounds(const Shape& shape) {
  return std::visit([&](const auto& geometry) { return bounds_of(shape.pose, geometry); }, shape.geometry);
}

AlignedBox3d bounds(const Robot& robot) {
  AlignedBox3d result;
  for (const Shape& shape : whole_shapes(robot)) result.extend(bounds(shape));
  if (!robot.legs) return result;
  constexpr double quarter = 1.5707963267948966;
  for (const LegDrive::Leg& leg : robot.legs->legs) {
    for (const double way : {0.0, quarter, 2 * quarter}) result.extend(leg.hip + robot.legs->place(0, way));
  }
  return result;
}

}  // namespace muster::description
