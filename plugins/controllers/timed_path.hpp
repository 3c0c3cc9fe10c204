// Reference motion along way points with a stop at each: trapezoidal speed profile of constant acceleration, constant
// speed and constant deceleration.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace muster {

using Vector = std::array<double, 3>;

struct WayPoint3d {
  static constexpr const char* columns = "x[m] y[m] z[m] +";
  double x, y, z;
};

// One coordinate along the path, its rate and its acceleration.
struct Along {
  double s, v, a;
};

// `way` [m] from rest to rest at no more than `speed` [m/s] and `acceleration` [m/s2].
class Leg {
 public:
  Leg(double way, double speed, double acceleration) : way_(way), a_(acceleration) {
    top_ = std::min(speed, std::sqrt(way * acceleration));
    ramp_ = top_ / a_;
    duration_ = top_ > 0 ? way / top_ + ramp_ : 0;
  }
  double duration() const { return duration_; }

  Along at(double t) const {
    if (t <= 0) return {0, 0, 0};
    if (t < ramp_) return {a_ * t * t / 2, a_ * t, a_};
    const double left = duration_ - t;
    if (left <= 0) return {way_, 0, 0};
    if (left < ramp_) return {way_ - a_ * left * left / 2, a_ * left, -a_};
    return {top_ * (t - ramp_ / 2), top_, 0};
  }

 private:
  double way_, a_, top_, ramp_, duration_;
};

struct Reference {
  Vector place, velocity, acceleration;
};

// Along `points` (at least one), with `wait` [s] at each; from the last to the first again where it loops.
template <class Points>
Reference timed_path(const Points& points, double t, double speed, double acceleration, double wait, bool loop) {
  const auto at = [&](std::size_t i) { return Vector{points[i].x, points[i].y, points[i].z}; };
  const std::size_t count = points.size(), legs = loop ? count : count - 1;
  const auto leg = [&](std::size_t i) {
    const Vector a = at(i), b = at((i + 1) % count);
    return Leg(std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]), speed, acceleration);
  };
  double round = 0;
  for (std::size_t i = 0; i < legs; ++i) round += wait + leg(i).duration();
  if (loop && t > 0 && round > 0) t = std::fmod(t, round);
  for (std::size_t i = 0; i < legs; ++i) {
    const Leg now = leg(i);
    if (t > wait + now.duration()) {
      t -= wait + now.duration();
      continue;
    }
    const Along along = now.at(t - wait);
    const Vector a = at(i), b = at((i + 1) % count);
    const double way = now.at(now.duration() + 1).s;
    Reference result{a, {}, {}};
    for (std::size_t k = 0; k < 3 && way > 0; ++k) {
      const double share = (b[k] - a[k]) / way;
      result.place[k] += share * along.s;
      result.velocity[k] = share * along.v;
      result.acceleration[k] = share * along.a;
    }
    return result;
  }
  return {at(loop ? 0 : count - 1), {}, {}};
}

}  // namespace muster
