// Robots with limbs: bodies on joints without motors.
#pragma once

#include "limbs.hpp"
#include "scarabs.hpp"

namespace muster::simbody {

using description::JointKind;
using description::Robot;
using Eigen::Matrix3d;
using Eigen::Vector3d;

inline description::Joint& hang(Robot& robot, JointKind kind, const Vector3d& at, const description::Mass& mass,
                                std::size_t parent = 0) {
  const std::string name = "limb" + std::to_string(robot.links.size());
  robot.links.push_back({name, mass, {}});
  description::Joint joint;
  joint.name = name + "_joint";
  joint.kind = kind;
  joint.parent = parent;
  joint.child = robot.links.size() - 1;
  joint.origin = Eigen::Translation3d(at);
  robot.joints.push_back(joint);
  return robot.joints.back();
}

inline void turn(Limb& limb, const Eigen::Quaterniond& q) {
  limb.qw = q.w(), limb.qx = q.x(), limb.qy = q.y(), limb.qz = q.z();
}

// A robot with every kind of limb: on the body, on each other, none of them straight.
inline Robot tree(const Robot& root, bool with_slider) {
  Robot robot = root;
  const auto body = [](double m, const Vector3d& centre) {
    return description::Mass{m, centre, (1e-3 * Vector3d(1, 1.5, 2)).asDiagonal()};
  };
  const Vector3d tilted = Vector3d(1, 2, -0.5).normalized();
  hang(robot, JointKind::continuous, {0.1, 0, 0.2}, body(0.3, {0.1, 0.02, -0.1})).axis = tilted;
  robot.joints.back().origin.rotate(Eigen::AngleAxisd(0.4, tilted));
  robot.joints.back().damping = 0.01;
  hang(robot, JointKind::ball, {0, 0.1, -0.2}, body(0.2, {0.05, 0.03, -0.2}), robot.links.size() - 1).damping = 0.02;
  robot.joints.back().origin.rotate(Eigen::AngleAxisd(-0.7, Vector3d::UnitX()));
  if (!with_slider) return robot;
  hang(robot, JointKind::prismatic, {0, 0, -0.1}, body(0.1, {0.01, 0.02, 0.03}), robot.links.size() - 1).axis = tilted;
  hang(robot, JointKind::revolute, {-0.1, 0, 0}, body(0.25, {0, 0.1, 0.1})).axis = Vector3d::UnitX();
  return robot;
}

}  // namespace muster::simbody
