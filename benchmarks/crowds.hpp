// Many Scarabs close together, and what may go wrong with them.
#pragma once

#include <algorithm>
#include <muster/random.hpp>

#include "contact_detection.hpp"
#include "tests/plugins/physics_simbody/fleet.hpp"

namespace muster::simbody {

constexpr double spacing = 0.45;  // [m]

inline scene::Wall wall(double x0, double y0, double x1, double y1, double thickness) {
  return {x0, y0, x1, y1, 0, 1, thickness, 0};
}

// A square of robots at rest.
inline std::vector<RobotState> square(int count, const std::function<double(int, double, double)>& heading) {
  const int side = static_cast<int>(std::ceil(std::sqrt(count)));
  std::vector<RobotState> states;
  for (int i = 0; i < count; ++i) {
    const int row = i / side;
    const double x = spacing * (i % side), y = spacing * row;
    states.push_back(at_rest(x, y, heading(i, x, y)));
  }
  return states;
}

// Four walls around a square of robots, 40 cm off, and two thin ones inside.
inline std::vector<scene::Wall> arena(int count) {
  const double side = std::ceil(std::sqrt(count)), x = spacing * (side - 1),
               y = spacing * (std::ceil(count / side) - 1);
  const double off = 0.45, low = -off - 0.05, right = x + off + 0.05, top = y + off + 0.05;
  return {wall(low, -off, right, -off, 0.1),  wall(low, y + off, right, y + off, 0.1),
          wall(-off, low, -off, top, 0.1),    wall(x + off, low, x + off, top, 0.1),
          wall(0.675, 0.3, 0.675, 1.2, 0.04), wall(1.5, 1.575, 2.6, 1.575, 0.04)};
}

// Speed and turn rate drawn anew each second, and reached within a quarter of it.
class RandomArcs {
 public:
  explicit RandomArcs(uint64_t seed) : stream_(seed) {}

  Command between(int robot, double from, double to) const {
    const Command a = at(robot, from), b = at(robot, to);
    return {a.left, a.right, (b.left - a.left) / (to - from), (b.right - a.right) / (to - from)};
  }

 private:
  Command at(int robot, double t) const {
    const uint64_t second = static_cast<uint64_t>(t + 1e-9);
    const double share = std::min(1.0, 4 * (t - static_cast<double>(second)));
    const auto v = [&](uint64_t k) { return k == 0 ? 0 : -0.2 + 0.8 * stream_.uniform(2 * robot, k); };
    const auto w = [&](uint64_t k) { return k == 0 ? 0 : -2 + 4 * stream_.uniform(2 * robot + 1, k); };
    return command(v(second) + share * (v(second + 1) - v(second)), w(second) + share * (w(second + 1) - w(second)));
  }

  Stream stream_;
};

constexpr int crowd = 50;

// Fifty that stand anyhow in an arena, and random arcs for them.
inline std::vector<RobotState> crowd_at_rest(uint64_t seed) {
  return square(crowd, [&](int i, double, double) { return 6.28 * Stream(seed).uniform(1000 + i); });
}

// Fifty that face their middle, and push on to it: one island in the end.
inline std::vector<RobotState> jam_at_rest() {
  const double middle = 0.5 * spacing * (std::ceil(std::sqrt(crowd)) - 1);
  return square(crowd, [&](int, double x, double y) { return std::atan2(middle - y, middle - x); });
}
inline Command inward(const Stream& stream, int robot, double t) {
  return command(0.4 * std::min(1.0, 2 * t), 0.6 * (stream.uniform(robot, static_cast<uint64_t>(t + 1e-9)) - 0.5));
}

// The worst that was seen.
struct Trouble {
  double deepest = 0;  // penetration of robots into each other, walls and ground [m]
  double rise = 0;     // of a mass centre [m/s]
  double tilt = 0;     // [rad]

  void see(const std::vector<RobotState>& states, const std::vector<scene::Slab>& slabs, double dt) {
    static const RobotModel model(scarab());
    static const Eigen::Vector3d centre = whole_mass(scarab()).centre;
    std::vector<Placed> robots(states.size());
    for (std::size_t i = 0; i < robots.size(); ++i) {
      const auto& pose = states[i].pose;
      robots[i].model = &model;
      robots[i].to_world = Eigen::Quaterniond(pose[3], pose[4], pose[5], pose[6]).toRotationMatrix();
      robots[i].position = {pose[0], pose[1], pose[2]};
      place_parts(robots[i]);
      tilt = std::max(tilt, std::acos(std::min(1.0, robots[i].to_world(2, 2))));
      for (const auto& frame : model.wheel_frame)
        deepest = std::max(
            deepest, model.drive.wheel_radius - (robots[i].position + robots[i].to_world * frame.translation()).z());
      heights_.resize(robots.size(), 1e9);
      const double height = (robots[i].position + robots[i].to_world * centre).z();
      rise = std::max(rise, (height - heights_[i]) / dt);
      heights_[i] = height;
    }
    std::vector<Solid> walls;
    for (const scene::Slab& s : slabs) walls.push_back(solid_of(s));
    for (std::size_t i = 0; i < robots.size(); ++i) {
      for (const Solid& part : robots[i].solids) {
        for (const Solid& obstacle : walls) look(part, obstacle);
        for (std::size_t j = i + 1; j < robots.size(); ++j) {
          if ((robots[i].position - robots[j].position).norm() > 2 * model.reach + 0.1) continue;
          for (const Solid& other : robots[j].solids) look(part, other);
        }
      }
    }
  }

 private:
  void look(const Solid& a, const Solid& b) {
    if ((a.centre - b.centre).norm() > a.reach() + b.reach()) return;
    const Touch t = touch(a, b, 0);
    for (int k = 0; k < t.count; ++k) deepest = std::max(deepest, -t.points[k].gap);
  }

  std::vector<double> heights_;
};

}  // namespace muster::simbody
