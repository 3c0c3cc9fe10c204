#include "model.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <muster/limbs.hpp>
#include <stdexcept>

namespace muster::ode {

using description::Robot;
using description::Shape;
using Eigen::Isometry3d;
using Eigen::Vector3d;

namespace {

constexpr double thinnest = 1e-3;  // [m] of a block: ODE accepts no flat ones

bool has_inertia(const description::Mass& mass) { return mass.mass > 0 && mass.inertia.llt().info() == Eigen::Success; }

// Reason why ODE cannot model a limb; "" if it can.
std::string why_not(const Robot& robot, const description::LimbJoint& limb) {
  using description::JointKind;
  constexpr double half_turn = 3.14159265358979323846;
  const description::Joint& joint = robot.joints[limb.joint];
  if (limb.carrier == description::LimbJoint::driven) return "hangs on a wheel";
  if (std::string what = unmodelled(joint); !what.empty()) return what;
  if (joint.kind == JointKind::revolute && (joint.lower <= -half_turn || joint.upper >= half_turn))
    return "has limits beyond half a turn, which ODE does not see";
  if (!has_inertia(rigid_mass(robot, joint.child))) return "carries a link without mass or inertia";
  return "";
}

std::vector<std::string> lacks(const Robot& robot) {
  if (robot.legs) return {"it walks"};
  std::vector<std::string> result;
  std::vector<std::size_t> wheels;
  if (robot.drive) {
    for (const description::Follower& wheel : robot.drive->wheels()) wheels.push_back(wheel.joint);
  }
  const std::vector<description::LimbJoint> limbs = limbs_of(robot);
  for (const description::LimbJoint& limb : limbs) {
    if (const std::string why = why_not(robot, limb); !why.empty())
      result.push_back("joint '" + robot.joints[limb.joint].name + "' " + why);
  }
  if (limbs.size() > Limbs::most) result.push_back("it has more than four joints without motors");
  if (robot.restitution > 0 && robot.drive) result.push_back("it bounces on wheels, where ODE's impacts gain energy");
  if (!has_inertia(rigid_mass(robot, 0))) result.push_back("its body has no mass or inertia");
  for (const std::size_t joint : wheels) {
    if (has_inertia(rigid_mass(robot, robot.joints[joint].child))) continue;
    result.push_back("the wheel of joint '" + robot.joints[joint].name + "' has no mass or inertia");
  }
  return result;
}

Wheel wheel_of(const Robot& robot, const description::Follower& wheel) {
  const description::Joint& joint = robot.joints[wheel.joint];
  Isometry3d frame = joint.origin;
  for (std::size_t link = joint.parent; link != 0; link = robot.joints[link - 1].parent) {
    frame = robot.joints[link - 1].origin * frame;
  }
  return {wheel.side, rigid_mass(robot, joint.child), frame, joint.axis};
}

// A shape as a box in its own frame: itself, or the smallest around it along the frame's axes.
Block block_of(const Shape& shape, const Isometry3d& frame, bool is_wheel) {
  Vector3d low, high;
  if (const auto* box = std::get_if<description::Box>(&shape.geometry)) {
    high = box->size / 2, low = -high;
  } else if (const auto* sphere = std::get_if<description::Sphere>(&shape.geometry)) {
    high.setConstant(sphere->radius), low = -high;
  } else if (const auto* cylinder = std::get_if<description::Cylinder>(&shape.geometry)) {
    high << cylinder->radius, cylinder->radius, cylinder->length / 2;
    low = -high;
  } else {
    const auto& vertices = std::get<description::Mesh>(shape.geometry).vertices;
    high = low = vertices.empty() ? Vector3d(Vector3d::Zero()) : vertices.front();
    for (const Vector3d& v : vertices) low = low.cwiseMin(v), high = high.cwiseMax(v);
  }
  const Isometry3d pose = frame * shape.pose * Eigen::Translation3d((low + high) / 2);
  return {pose, (high - low).cwiseMax(thinnest), is_wheel};
}

}  // namespace

RobotModel::RobotModel(const Robot& robot) {
  std::string list;
  for (const std::string& one : lacks(robot)) list += (list.empty() ? "" : "; ") + one;
  if (!list.empty()) {
    throw std::runtime_error("robot model '" + robot.name + "' (" + robot.file +
                             ") cannot be simulated by physics.ode: " + list);
  }
  is_driven = robot.is_driven();
  has_wheels = robot.drive.has_value();
  rotors = robot.quadrotor;
  restitution = robot.restitution;
  mass = whole_mass(robot).mass;
  body = rigid_mass(robot, 0);
  take_shapes(robot, 0, -1);
  for (const description::LimbJoint& limb : limbs_of(robot)) {
    take_shapes(robot, robot.joints[limb.joint].child, static_cast<int>(limbs.size()));
    limbs.push_back(limb_model(robot, limb));
  }
  if (!has_wheels) return;
  drive = *robot.drive;
  for (const description::Follower& one : drive.wheels()) {
    wheels.push_back(wheel_of(robot, one));
    for (const Shape& shape : rigid_shapes(robot, robot.joints[one.joint].child)) {
      blocks.push_back(block_of(shape, wheels.back().frame, true));
    }
  }
  for (std::size_t side = 0; drive.steering && side < 2; ++side) {
    for (const Shape& shape : steered_shapes(robot, side))
      blocks.push_back(block_of(shape, Isometry3d::Identity(), true));
  }
}

void RobotModel::take_shapes(const Robot& robot, std::size_t link, int limb) {
  for (const Shape& shape : link == 0 ? body_shapes(robot) : rigid_shapes(robot, link)) {
    if (const auto* sphere = std::get_if<description::Sphere>(&shape.geometry)) {
      balls.push_back({shape.pose.translation(), sphere->radius, limb});
    } else {
      blocks.push_back(block_of(shape, Isometry3d::Identity(), false));
      blocks.back().limb = limb;
    }
  }
}

}  // namespace muster::ode
