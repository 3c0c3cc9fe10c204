// A polyline as a one-dimensional manifold: places by arclength, arclength by places, and path following.
#pragma once

#include <algorithm>
#include <cmath>
#include <muster/plugin.hpp>
#include <vector>

namespace muster {

struct Waypoint {
  static constexpr const char* columns = "x[m] y[m] +";
  double x, y;
};

class Roadmap {
 public:
  Roadmap() = default;
  template <class Points>
  explicit Roadmap(const Points& points) : points_(points.begin(), points.end()) {
    if (points_.size() < 2) throw BadInput("the roadmap has fewer than two points");
    from_start_.push_back(0);
    for (std::size_t i = 1; i < points_.size(); ++i) {
      const double length = std::hypot(points_[i].x - points_[i - 1].x, points_[i].y - points_[i - 1].y);
      if (!(length > 0)) throw BadInput("the roadmap has the same point twice in succession");
      from_start_.push_back(from_start_.back() + length);
    }
  }

  bool empty() const { return points_.empty(); }
  double length() const { return from_start_.back(); }

  // The place at arclength s [m]; before the start and past the end, on the extension of the first or last piece.
  Waypoint at(double s) const {
    const auto above = std::upper_bound(from_start_.begin() + 1, from_start_.end() - 1, s);
    const std::size_t i = static_cast<std::size_t>(above - from_start_.begin());
    const double t = (s - from_start_[i - 1]) / (from_start_[i] - from_start_[i - 1]);
    const Waypoint &a = points_[i - 1], &b = points_[i];
    return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
  }

  // The arclength within [low, high] that is nearest to a place.
  double nearest(const Waypoint& p, double low, double high) const {
    double best = std::clamp(low, 0.0, length()), best_distance = distance(p, at(best));
    for (std::size_t i = 1; i < points_.size(); ++i) {
      const double first = std::max(from_start_[i - 1], low), last = std::min(from_start_[i], high);
      if (first > last) continue;
      const Waypoint &a = points_[i - 1], &b = points_[i];
      const double piece = from_start_[i] - from_start_[i - 1];
      const double along = ((p.x - a.x) * (b.x - a.x) + (p.y - a.y) * (b.y - a.y)) / piece;
      const double s = std::clamp(from_start_[i - 1] + along, first, last);
      if (const double d = distance(p, at(s)); d < best_distance) {
        best = s;
        best_distance = d;
      }
    }
    return best;
  }

  static double distance(const Waypoint& a, const Waypoint& b) { return std::hypot(a.x - b.x, a.y - b.y); }

 private:
  std::vector<Waypoint> points_;
  std::vector<double> from_start_;  // [m]
};

// Pure pursuit (Coulter 1992): the command at speed v [m/s], backwards if negative, along the circle through the target
// that is tangent to the heading. Turns on the spot if the target is far off the heading.
inline Command pursuit(const Odometry& at, const Waypoint& target, double v, double turn_speed) {
  constexpr double aside = 1.0;  // [rad]
  const double dx = target.x - at.x, dy = target.y - at.y;
  const double ahead = dx * std::cos(at.yaw) + dy * std::sin(at.yaw);
  const double left = dy * std::cos(at.yaw) - dx * std::sin(at.yaw);
  const double square = dx * dx + dy * dy;
  if (v == 0 || square == 0) return {0, 0};
  const double bearing = v > 0 ? std::atan2(left, ahead) : std::atan2(-left, -ahead);
  if (std::abs(bearing) > aside) return {0, std::copysign(turn_speed, bearing)};
  return {v, v * 2 * left / square};
}

}  // namespace muster
