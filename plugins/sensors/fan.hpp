// Ray casting of a laser: the first hit of each ray.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>
#include <vector>

#include "ray.hpp"

namespace muster {

// An obstacle for lasers: a shape, and the box around it in the shape's own frame.
struct Solid {
  description::Shape shape;
  Eigen::AlignedBox3d box;

  explicit Solid(const description::Shape& of)
      : shape(of), box(description::bounds({Eigen::Isometry3d::Identity(), of.geometry})) {}
};

// The rays of one laser, and their ranges.
class Fan {
 public:
  // Obstacles beyond `reach` [m] may be skipped.
  Fan(const description::Laser& laser, double reach)
      : laser_(laser),
        reach_(reach),
        ranges_(static_cast<std::size_t>(laser.samples), std::numeric_limits<double>::infinity()) {}

  // Infinite for a ray without a hit.
  const std::vector<double>& ranges() const { return ranges_; }

  // A level ground, `height` below the laser; `down` in its frame.
  void meet_ground(double height, const Eigen::Vector3d& down) {
    for (std::size_t i = 0; i < ranges_.size(); ++i) {
      const double sinks = way(i).dot(down);
      if (height <= 0 || sinks > 0) shorten(i, height <= 0 ? 0 : height / sinks);
    }
  }

  // A solid fixed to a frame, which is given in the laser's.
  void meet(const Solid& solid, const Eigen::Isometry3d& frame) {
    const Eigen::Isometry3d pose = frame * solid.shape.pose, seen = pose.inverse();
    Eigen::Matrix<double, 3, 8> corners;
    for (int i = 0; i < 8; ++i)
      corners.col(i) = pose * solid.box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i));
    if (corners.row(2).minCoeff() > 0 || corners.row(2).maxCoeff() < 0) return;
    if (solid.box.exteriorDistance(seen.translation()) > reach_) return;
    std::visit(
        [&](const auto& geometry) {
          between(corners.topRows<2>(), [&](std::size_t i) {
            const Ray ray{seen.translation(), seen.linear() * way(i)};
            if (entry(ray, solid.box) < ranges_[i]) shorten(i, entry(ray, geometry));
          });
        },
        solid.shape.geometry);
  }

 private:
  Eigen::Vector3d way(std::size_t i) const {
    const double angle = laser_.min_angle + static_cast<double>(i) * laser_.step();
    return {std::cos(angle), std::sin(angle), 0};
  }
  void shorten(std::size_t i, double range) { ranges_[i] = std::min(ranges_[i], range); }

  // Calls visit(i) for each ray that may hit anything between the corners.
  template <class Visit>
  void between(const Eigen::Matrix<double, 2, 8>& corners, const Visit& visit) const {
    constexpr double turn = 6.283185307179586, slack = 1e-9;  // [rad], slack: of rounding
    const Eigen::Vector2d middle = corners.rowwise().mean();
    const double towards = std::atan2(middle.y(), middle.x());
    double right = 0, left = 0;  // angular extent to both sides of that
    for (int i = 0; i < 8; ++i) {
      const double off = std::remainder(std::atan2(corners(1, i), corners(0, i)) - towards, turn);
      right = std::min(right, off);
      left = std::max(left, off);
    }
    const bool is_around = left - right >= turn / 2;
    if (is_around || laser_.samples == 1) {
      for (std::size_t i = 0; i < ranges_.size(); ++i) visit(i);
      return;
    }
    for (int turns = -2; turns <= 2; ++turns) {
      const double from = towards + right - slack + turns * turn, to = towards + left + slack + turns * turn;
      const double first = std::max(0.0, std::ceil((from - laser_.min_angle) / laser_.step()));
      const double last = std::min(laser_.samples - 1.0, std::floor((to - laser_.min_angle) / laser_.step()));
      if (first > last) continue;
      for (auto i = static_cast<std::size_t>(first); i <= static_cast<std::size_t>(last); ++i) visit(i);
    }
  }

  const description::Laser& laser_;
  double reach_;
  std::vector<double> ranges_;
};

}  // namespace muster
