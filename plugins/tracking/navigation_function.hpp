// Navigation functions in a world of discs: Rimon and Koditschek, Exact robot navigation using artificial potential
// functions, IEEE Transactions on Robotics and Automation 8(5), 1992.
#pragma once

#include <cmath>
#include <utility>
#include <vector>

namespace muster::tracking {

struct Disc {
  static constexpr const char* columns = "x[m] y[m] radius[m]";
  double x, y, radius;
};

struct Vector2 {
  double x, y;
};

// phi = g / (g^k + b)^(1/k): g is the squared distance to the goal, b the product of the clearances
// radius^2 - distance^2 within each bound and distance^2 - radius^2 outside each obstacle. It is 0 at the goal alone
// and 1 where the robot touches a bound or an obstacle. With one bound, disjoint obstacles inside it and a sharpness k
// that is large enough the goal is the only minimum, so that the way down ends there from almost everywhere.
class NavigationFunction {
 public:
  NavigationFunction(Vector2 goal, std::vector<Disc> bounds, std::vector<Disc> obstacles, double sharpness)
      : goal_(goal), bounds_(std::move(bounds)), obstacles_(std::move(obstacles)), sharpness_(sharpness) {}

  // The least clearance [m], below 0 outside a bound or inside an obstacle.
  double room(Vector2 at) const {
    double least = INFINITY;
    for (const Disc& d : bounds_) least = std::fmin(least, d.radius - distance(at, d));
    for (const Disc& d : obstacles_) least = std::fmin(least, distance(at, d) - d.radius);
    return least;
  }

  double value(Vector2 at) const {
    if (room(at) <= 0) return 1;
    const double g = squared(at);
    return g == 0 ? 0 : 1 / std::pow(1 + std::exp(-log_odds(at)), 1 / sharpness_);
  }

  // log(g^k / b), which rises with phi: minus infinity at the goal, infinite on edges. It still tells places apart
  // where phi is so near to 1 that a double cannot.
  double log_odds(Vector2 at) const {
    if (room(at) <= 0) return INFINITY;
    return sharpness_ * std::log(squared(at)) - log_product(at);
  }

  // Of phi, where there is room. With s = b / g^k, phi = (1 + s)^(-1/k) and d phi = -phi / k  s / (1 + s)  d log s.
  Vector2 gradient(Vector2 at) const {
    const double g = squared(at);
    if (g == 0) return {0, 0};
    const double phi = value(at), share = 1 - std::pow(phi, sharpness_);  // s / (1 + s)
    const Vector2 slope = slope_of_log(at);
    const double scale = -phi / sharpness_ * share;
    return {scale * slope.x, scale * slope.y};
  }

  // The way down, of length 1: also where the gradient is too small for a double. {0, 0} at the goal.
  Vector2 downhill(Vector2 at) const {
    if (squared(at) == 0) return {0, 0};
    const Vector2 slope = slope_of_log(at);
    const double length = std::hypot(slope.x, slope.y);
    return length == 0 ? Vector2{0, 0} : Vector2{slope.x / length, slope.y / length};
  }

 private:
  static double distance(Vector2 at, const Disc& d) { return std::hypot(at.x - d.x, at.y - d.y); }
  double squared(Vector2 at) const { return (at.x - goal_.x) * (at.x - goal_.x) + (at.y - goal_.y) * (at.y - goal_.y); }
  double log_product(Vector2 at) const {
    double sum = 0;
    for (const Disc& d : bounds_) sum += std::log(clearance(at, d));
    for (const Disc& d : obstacles_) sum += std::log(-clearance(at, d));
    return sum;
  }
  static double clearance(Vector2 at, const Disc& d) {
    return d.radius * d.radius - (at.x - d.x) * (at.x - d.x) - (at.y - d.y) * (at.y - d.y);
  }
  // Gradient of log(b / g^k).
  Vector2 slope_of_log(Vector2 at) const {
    Vector2 sum{0, 0};
    const auto add = [&](double x, double y, double factor) {
      sum.x += factor * 2 * (at.x - x), sum.y += factor * 2 * (at.y - y);
    };
    for (const Disc& d : bounds_) add(d.x, d.y, -1 / clearance(at, d));
    for (const Disc& d : obstacles_) add(d.x, d.y, -1 / clearance(at, d));
    add(goal_.x, goal_.y, -sharpness_ / squared(at));
    return sum;
  }

  Vector2 goal_;
  std::vector<Disc> bounds_, obstacles_;
  double sharpness_;
};

// The place nearest to `at` that keeps `margin` from every bound and obstacle, as far as moving away from one does not
// lead to another.
inline Vector2 inside(Vector2 at, const std::vector<Disc>& bounds, const std::vector<Disc>& obstacles, double margin) {
  const auto put = [&](const Disc& d, double radius) {
    const double far = std::hypot(at.x - d.x, at.y - d.y);
    at = far > 0 ? Vector2{d.x + (at.x - d.x) * radius / far, d.y + (at.y - d.y) * radius / far}
                 : Vector2{d.x + radius, d.y};
  };
  for (int round = 0; round < 8; ++round) {
    for (const Disc& d : bounds) {
      if (std::hypot(at.x - d.x, at.y - d.y) > d.radius - margin) put(d, std::fmax(0, d.radius - margin));
    }
    for (const Disc& d : obstacles) {
      if (std::hypot(at.x - d.x, at.y - d.y) < d.radius + margin) put(d, d.radius + margin);
    }
  }
  return at;
}

}  // namespace muster::tracking
