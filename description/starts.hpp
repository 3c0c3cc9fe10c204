// Robots that a world puts into walls or into each other, for backends that would push them out without a word.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <muster/tables.hpp>
#include <string>
#include <vector>

#include "description/file_text.hpp"
#include "description/robot.hpp"

namespace muster::description::starts {

// A box upright in the world, turned about z.
struct Block {
  double x, y, cos_yaw, sin_yaw;  // middle [m], heading
  double half_length, half_width, low, high;
  std::size_t row = 0;  // of a wall, for its name
};

// A wall's part as a block, from a slab as scene::slabs() makes them.
template <class Slab>
Block block_of(const Slab& w) {
  return {w.x,
          w.y,
          w.cos_yaw,
          w.sin_yaw,
          w.length / 2,
          w.thickness / 2,
          w.z - w.height / 2,
          w.z + w.height / 2,
          static_cast<std::size_t>(w.wall)};
}

// How far two blocks are in each other, in plan [m]; 0 if they are apart, or one is over the other.
inline double depth(const Block& a, const Block& b) {
  constexpr double touching = 1e-3;  // [m] in height: what stands on something is not in it
  if (std::min(a.high, b.high) - std::max(a.low, b.low) <= touching) return 0;
  double least = std::numeric_limits<double>::infinity();
  const double dx = b.x - a.x, dy = b.y - a.y;
  const auto reach = [](const Block& c, double ax, double ay) {
    return c.half_length * std::abs(c.cos_yaw * ax + c.sin_yaw * ay) +
           c.half_width * std::abs(c.cos_yaw * ay - c.sin_yaw * ax);
  };
  for (const Block* of : {&a, &b}) {
    const double axes[2][2] = {{of->cos_yaw, of->sin_yaw}, {-of->sin_yaw, of->cos_yaw}};
    for (const auto& axis : axes) {
      const double apart = std::abs(dx * axis[0] + dy * axis[1]);
      least = std::min(least, reach(a, axis[0], axis[1]) + reach(b, axis[0], axis[1]) - apart);
    }
  }
  return std::max(0.0, least);
}

// The boxes around a robot's collision shapes, along its own axes, each turned by its heading.
inline std::vector<Block> blocks_of(const Robot& robot, const Pose& pose) {
  const double yaw =
      std::atan2(2 * (pose.qw * pose.qz + pose.qx * pose.qy), 1 - 2 * (pose.qy * pose.qy + pose.qz * pose.qz));
  const double c = std::cos(yaw), s = std::sin(yaw);
  std::vector<Block> result;
  for (const Shape& shape : whole_shapes(robot)) {
    const Eigen::AlignedBox3d box = bounds(shape);
    const Eigen::Vector3d middle = box.center(), half = box.sizes() / 2;
    result.push_back({pose.x + c * middle.x() - s * middle.y(), pose.y + s * middle.x() + c * middle.y(), c, s,
                      half.x(), half.y(), pose.z + box.min().z(), pose.z + box.max().z(), 0});
  }
  return result;
}

inline double deepest(const std::vector<Block>& a, const std::vector<Block>& b) {
  double result = 0;
  for (const Block& one : a) {
    for (const Block& other : b) result = std::max(result, depth(one, other));
  }
  return result;
}

// A robot that starts in a wall, in another robot, below the ground, or in the air without wings.
struct Fault {
  std::size_t robot;
  std::string message;
};

// Where the third number of `at` is a usual angle and there is no heading, as in a pose of ROS in the plane.
inline std::string heading_as_height(const Pose& pose) {
  constexpr double thirtieth = 3.141592653589793 / 6, fortyfifth = 3.141592653589793 / 4, rounding = 0.006;
  const bool has_turn = pose.qx != 0 || pose.qy != 0 || pose.qz != 0;
  const auto is_near = [&](double part) { return std::abs(std::remainder(pose.z, part)) < rounding; };
  if (has_turn || pose.z < thirtieth - rounding || !(is_near(thirtieth) || is_near(fortyfifth))) return "";
  return "; is the third number a heading? at=\"" + print_number(pose.x) + ' ' + print_number(pose.y) +
         " 0\" heading=\"" + print_number(std::round(pose.z * 1e4) / 1e4) + '"';
}

// One for each robot that starts with its middle below the ground (z = 0), on wheels or legs far above it, in a wall,
// or in a robot before it. `pose_of(row)`, `robot_of(row)`: null for a robot that is not there; `name_of(set, row)`.
template <class PoseOf, class RobotOf, class NameOf>
std::vector<Fault> faults(std::size_t robots, const PoseOf& pose_of, const RobotOf& robot_of, const NameOf& name_of,
                          const std::vector<Block>& walls) {
  constexpr double tolerance = 1e-3;  // [m] boxes around round shapes may be that deep in each other
  constexpr double high = 0.1;        // [m] lower than that, a robot on wheels or legs settles
  constexpr double no_robot = 50;     // [m] of its middle: its description has been told of, and not where it starts
  std::vector<std::vector<Block>> blocks(robots);
  std::vector<double> reach(robots, 0);
  std::vector<Fault> result;
  const auto millimetres = [](double metres) { return std::to_string(std::lround(1000 * metres)); };
  const auto say = [&](std::size_t row, const std::string& set, std::size_t other, double deep) {
    result.push_back({row, "robot '" + std::string(name_of("robot", row)) + "' starts in " + set + " '" +
                               std::string(name_of(set.c_str(), other)) + "', " + millimetres(deep) +
                               " mm deep, and will be pushed out; expected a place (at) clear of it"});
  };
  for (std::size_t i = 0; i < robots; ++i) {
    const Robot* robot = robot_of(i);
    if (!robot) continue;
    const Pose pose = pose_of(i);
    blocks[i] = blocks_of(*robot, pose);
    for (const Block& b : blocks[i])
      reach[i] = std::max(reach[i], std::hypot(b.x - pose.x, b.y - pose.y) + std::hypot(b.half_length, b.half_width));
    double foot = std::numeric_limits<double>::infinity();
    for (const Block& b : blocks[i]) foot = std::min(foot, b.low);
    if ((robot->drive || robot->legs) && !robot->quadrotor && foot > high && std::isfinite(foot))
      result.push_back({i, "robot '" + std::string(name_of("robot", i)) + "' starts " + millimetres(foot) +
                               " mm above the ground, and falls; expected a place (at) on it, z = " +
                               (pose.z - foot < high / 10 ? "0" : millimetres(pose.z - foot) + " mm") +
                               heading_as_height(pose)});
    double lowest = 0, highest = -std::numeric_limits<double>::infinity();
    for (const Block& b : blocks[i]) lowest = std::min(lowest, b.low), highest = std::max(highest, b.high);
    if (lowest + highest < 0)
      result.push_back({i, "robot '" + std::string(name_of("robot", i)) + "' starts " + millimetres(-lowest) +
                               " mm below the ground; expected a place (at) on it, z = 0 or above"});
    if (reach[i] > no_robot) continue;
    for (const Block& wall : walls) {
      const double deep = deepest(blocks[i], {wall});
      if (deep <= tolerance) continue;
      say(i, "wall", wall.row, deep);
      break;
    }
    for (std::size_t j = 0; j < i; ++j) {
      const Pose other = pose_of(j);
      if (blocks[j].empty() || std::hypot(other.x - pose.x, other.y - pose.y) > reach[i] + reach[j]) continue;
      const double deep = deepest(blocks[i], blocks[j]);
      if (deep <= tolerance) continue;
      say(i, "robot", j, deep);
      break;
    }
  }
  return result;
}

}  // namespace muster::description::starts
