// Kinds of joints and their degrees of freedom.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <limits>
#include <string>

namespace muster::description {

enum class JointKind { fixed = 1, revolute, continuous, prismatic, floating, planar, ball };

// Degrees of freedom of a kind of joint: number of coordinates (a rotation in space has four, a quaternion w first),
// number of rates, whether it has an axis, and whether it has limits.
struct JointLaw {
  JointKind kind;
  const char* name;
  int positions, rates;
  bool has_axis, has_limits;
};

constexpr std::array<JointLaw, 7> joint_laws = {{
    {JointKind::fixed, "fixed", 0, 0, false, false},
    {JointKind::revolute, "revolute", 1, 1, true, true},       // about the axis [rad]
    {JointKind::continuous, "continuous", 1, 1, true, false},  // the same, without limits
    {JointKind::prismatic, "prismatic", 1, 1, true, true},     // along the axis [m]
    {JointKind::floating, "floating", 7, 6, false, false},     // in all directions [m], about all axes
    {JointKind::planar, "planar", 3, 3, true, false},  // along both directions across the axis [m], about it [rad]
    {JointKind::ball, "ball", 4, 3, false, false},     // about all axes through its origin
}};

constexpr const JointLaw& law_of(JointKind kind) { return joint_laws[static_cast<std::size_t>(kind) - 1]; }

struct Joint {
  std::string name;
  JointKind kind = JointKind::fixed;
  std::size_t parent = 0, child = 0;                         // indices of links
  Eigen::Isometry3d origin = Eigen::Isometry3d::Identity();  // of the child's frame in the parent's, at position 0
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();           // unit, in the child's frame; the normal if planar
  double lower = -std::numeric_limits<double>::infinity();   // [rad] or [m]
  double upper = std::numeric_limits<double>::infinity();
  double max_effort = std::numeric_limits<double>::infinity();  // [N m] or [N]
  double max_speed = std::numeric_limits<double>::infinity();   // [rad/s] or [m/s]
  double damping = 0;                                           // [N m s/rad] or [N s/m]
  double friction = 0;                                          // Coulomb's, of the joint itself [N m] or [N]
  bool is_in_degrees = false;  // its angles are no radians, it seems: a warning asks so
};

}  // namespace muster::description
