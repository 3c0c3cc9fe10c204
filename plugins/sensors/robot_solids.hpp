// What sensors see of a robot: its body, and its wheels, which are round and independent of their angle.
#pragma once

#include <vector>

#include "description/robot.hpp"

namespace muster {

inline std::vector<description::Shape> seen_of(const description::Robot& robot) {
  std::vector<description::Shape> result = rigid_shapes(robot, 0);
  if (!robot.drive) return result;
  for (const description::Follower& wheel : robot.drive->wheels()) {
    const description::Joint& joint = robot.joints[wheel.joint];
    const Eigen::Isometry3d hub = *frame_on_body(robot, joint.parent) * joint.origin;
    for (description::Shape shape : rigid_shapes(robot, joint.child)) {
      shape.pose = hub * shape.pose;
      result.push_back(std::move(shape));
    }
  }
  return result;
}

}  // namespace muster
