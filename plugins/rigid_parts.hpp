// Parts of a robot as a general engine of rigid bodies takes them: spheres, boxes and wheels, each with its place.
#pragma once

#include <Eigen/Cholesky>
#include <functional>
#include <muster/limbs.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "description/robot.hpp"

namespace muster::rigid {

// A sphere fixed to the body, which slides on it without friction if driven, or to a limb.
struct Ball {
  Eigen::Vector3d centre;  // in the frame of its carrier [m]
  double radius;           // [m]
  int limb = -1;           // -1: the body
};

// A box fixed to the body or a limb.
struct Block {
  Eigen::Isometry3d pose;  // in the frame of its carrier
  Eigen::Vector3d size;    // full edges [m]
  bool is_wheel;           // it represents a wheel among obstacles and does not turn; the ground touches its sphere
  int limb = -1;           // -1: the body
};

struct Wheel {
  int side;                 // 0 left, 1 right
  description::Mass mass;   // in the joint's frame
  Eigen::Isometry3d frame;  // of the joint in the body's
  Eigen::Vector3d axis;     // unit, in the joint's frame
};

inline bool has_inertia(const description::Mass& mass) {
  return mass.mass > 0 && mass.inertia.llt().info() == Eigen::Success;
}

inline Wheel wheel_of(const description::Robot& robot, const description::Follower& wheel) {
  const description::Joint& joint = robot.joints[wheel.joint];
  Eigen::Isometry3d frame = joint.origin;
  for (std::size_t link = joint.parent; link != 0; link = robot.joints[link - 1].parent) {
    frame = robot.joints[link - 1].origin * frame;
  }
  return {wheel.side, rigid_mass(robot, joint.child), frame, joint.axis};
}

// A shape as a box in its own frame: itself, or the smallest around it along the frame's axes.
inline Block block_of(const description::Shape& shape, const Eigen::Isometry3d& frame, bool is_wheel) {
  constexpr double thinnest = 1e-3;  // [m]: engines accept no flat ones
  Eigen::Vector3d low, high;
  if (const auto* box = std::get_if<description::Box>(&shape.geometry)) {
    high = box->size / 2, low = -high;
  } else if (const auto* sphere = std::get_if<description::Sphere>(&shape.geometry)) {
    high.setConstant(sphere->radius), low = -high;
  } else if (const auto* cylinder = std::get_if<description::Cylinder>(&shape.geometry)) {
    high << cylinder->radius, cylinder->radius, cylinder->length / 2;
    low = -high;
  } else {
    const auto& vertices = std::get<description::Mesh>(shape.geometry).vertices;
    high = low = vertices.empty() ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : vertices.front();
    for (const Eigen::Vector3d& v : vertices) low = low.cwiseMin(v), high = high.cwiseMax(v);
  }
  const Eigen::Isometry3d pose = frame * shape.pose * Eigen::Translation3d((low + high) / 2);
  return {pose, (high - low).cwiseMax(thinnest), is_wheel};
}

// What of a robot collides: balls and blocks of its body and limbs, blocks in place of its wheels.
struct Parts {
  std::vector<Wheel> wheels;  // the first of each side, then those that follow them
  std::vector<description::LimbModel> limbs;
  std::vector<Ball> balls;
  std::vector<Block> blocks;
};

inline void take_shapes(const description::Robot& robot, std::size_t link, int limb, Parts& parts) {
  for (const description::Shape& shape : link == 0 ? body_shapes(robot) : rigid_shapes(robot, link)) {
    if (const auto* sphere = std::get_if<description::Sphere>(&shape.geometry)) {
      parts.balls.push_back({shape.pose.translation(), sphere->radius, limb});
    } else {
      parts.blocks.push_back(block_of(shape, Eigen::Isometry3d::Identity(), false));
      parts.blocks.back().limb = limb;
    }
  }
}

inline Parts parts_of(const description::Robot& robot) {
  Parts parts;
  take_shapes(robot, 0, -1, parts);
  for (const description::LimbJoint& limb : limbs_of(robot)) {
    take_shapes(robot, robot.joints[limb.joint].child, static_cast<int>(parts.limbs.size()), parts);
    parts.limbs.push_back(limb_model(robot, limb));
  }
  if (!robot.drive) return parts;
  for (const description::Follower& one : robot.drive->wheels()) {
    parts.wheels.push_back(wheel_of(robot, one));
    for (const description::Shape& shape : rigid_shapes(robot, robot.joints[one.joint].child)) {
      parts.blocks.push_back(block_of(shape, parts.wheels.back().frame, true));
    }
  }
  for (std::size_t side = 0; robot.drive->steering && side < 2; ++side) {
    for (const description::Shape& shape : steered_shapes(robot, side))
      parts.blocks.push_back(block_of(shape, Eigen::Isometry3d::Identity(), true));
  }
  return parts;
}

// Reasons why an engine of rigid bodies cannot simulate a robot. `of_limb`: the engine's own for a limb's joint, "" if
// none.
inline std::vector<std::string> lacks(const description::Robot& robot,
                                      const std::function<std::string(const description::Joint&)>& of_limb) {
  if (robot.legs) return {"it walks"};
  std::vector<std::string> result;
  const std::vector<description::LimbJoint> limbs = limbs_of(robot);
  for (const description::LimbJoint& limb : limbs) {
    const description::Joint& joint = robot.joints[limb.joint];
    std::string why = limb.carrier == description::LimbJoint::driven ? "hangs on a wheel" : unmodelled(joint);
    if (why.empty()) why = of_limb(joint);
    if (why.empty() && !has_inertia(rigid_mass(robot, joint.child))) why = "carries a link without mass or inertia";
    if (!why.empty()) result.push_back("joint '" + joint.name + "' " + why);
  }
  if (limbs.size() > Limbs::most) result.push_back("it has more than four joints without motors");
  if (!has_inertia(rigid_mass(robot, 0))) result.push_back("its body has no mass or inertia");
  if (!robot.drive) return result;
  for (const description::Follower& wheel : robot.drive->wheels()) {
    const description::Joint& joint = robot.joints[wheel.joint];
    if (has_inertia(rigid_mass(robot, joint.child))) continue;
    result.push_back("the wheel of joint '" + joint.name + "' has no mass or inertia");
  }
  return result;
}

// Throws std::runtime_error with all reasons, if there are any.
inline void refuse(const description::Robot& robot, const std::string& engine,
                   const std::vector<std::string>& reasons) {
  if (reasons.empty()) return;
  std::string list;
  for (const std::string& one : reasons) list += (list.empty() ? "" : "; ") + one;
  throw std::runtime_error("robot model '" + robot.name + "' (" + robot.file + ") cannot be simulated by " + engine +
                           ": " + list);
}

// A robot that an engine accepts.
struct RobotModel : Parts {
  explicit RobotModel(const description::Robot& robot)
      : Parts(parts_of(robot)),
        is_driven(robot.is_driven()),
        has_wheels(robot.drive.has_value()),
        rotors(robot.quadrotor),
        restitution(robot.restitution),
        mass(whole_mass(robot).mass),
        body(rigid_mass(robot, 0)) {
    if (has_wheels) drive = *robot.drive;
  }

  bool is_driven;
  bool has_wheels;  // false: the wheels' fields below are unused
  description::DifferentialDrive drive;
  std::optional<description::Quadrotor> rotors;
  double restitution;
  double mass;             // of all parts [kg]
  description::Mass body;  // mass of the root and all that is fixed to it, in its frame
};

}  // namespace muster::rigid
