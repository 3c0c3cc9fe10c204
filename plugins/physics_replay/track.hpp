// A measured course: poses at times, with interpolation between them.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <vector>

namespace muster::replay {

struct Sample {
  double t;  // [s]
  Eigen::Vector3d place;
  Eigen::Quaterniond turn;  // body to world
};

struct Placed {
  Eigen::Vector3d place;
  Eigen::Quaterniond turn;
};

// Samples by rising time. Before the first and after the last the body is at rest.
class Track {
 public:
  bool empty() const { return samples_.empty(); }

  // False where time does not rise.
  bool append(const Sample& sample) {
    if (!samples_.empty() && !(sample.t > samples_.back().t)) return false;
    samples_.push_back(sample);
    return true;
  }

  Placed at(double t) const {
    const auto after =
        std::upper_bound(samples_.begin(), samples_.end(), t, [](double time, const Sample& s) { return time < s.t; });
    if (after == samples_.begin()) return {samples_.front().place, samples_.front().turn};
    const Sample& a = *(after - 1);
    if (after == samples_.end()) return {a.place, a.turn};
    const double share = (t - a.t) / (after->t - a.t);
    // slerp takes the shorter arc, so headings that wrap in the data need no care.
    return {a.place + share * (after->place - a.place), a.turn.slerp(share, after->turn)};
  }

 private:
  std::vector<Sample> samples_;
};

// The mean turn rate, in the world's frame, of a body that turned from a to b in dt [s].
inline Eigen::Vector3d turn_rate(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b, double dt) {
  const Eigen::AngleAxisd turned(b * a.conjugate());
  const double angle = turned.angle() > M_PI ? turned.angle() - 2 * M_PI : turned.angle();
  return (angle / dt) * turned.axis();
}

}  // namespace muster::replay
