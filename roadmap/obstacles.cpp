#include "roadmap/obstacles.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace muster::roadmap {
namespace {

constexpr double touch = 1e-7;  // [m] a line this little inside a rectangle runs along its border
constexpr double infinite = std::numeric_limits<double>::infinity();

// Cuts [from, to] to the part of a line, from `start` on by `change`, that lies within `half` of 0.
void clip(double start, double change, double half, double& from, double& to) {
  if (change == 0) {
    if (std::abs(start) >= half) to = -infinite;
    return;
  }
  const double one = (-half - start) / change, other = (half - start) / change;
  from = std::max(from, std::min(one, other));
  to = std::min(to, std::max(one, other));
}

}  // namespace

double distance(const Point& p, const Point& a, const Point& b) {
  const double x = b.x - a.x, y = b.y - a.y, square = x * x + y * y;
  const double t = square > 0 ? std::clamp(((p.x - a.x) * x + (p.y - a.y) * y) / square, 0.0, 1.0) : 0;
  return std::hypot(a.x + t * x - p.x, a.y + t * y - p.y);
}

Point Obstacles::Frame::local(const Point& p) const {
  const double x = p.x - middle.x, y = p.y - middle.y;
  return {x * axis.x + y * axis.y, y * axis.x - x * axis.y};
}

bool Obstacles::Frame::is_crossed(const Point& a, const Point& b, double grown) const {
  const Point p = local(a), q = local(b);
  double from = 0, to = 1;
  clip(p.x, q.x - p.x, half_length + grown - touch, from, to);
  if (from >= to) return false;
  clip(p.y, q.y - p.y, half_width + grown - touch, from, to);
  return from < to;
}

Obstacles::Obstacles(const std::vector<Block>& blocks, double radius) : blocks_(blocks), radius_(radius) {
  if (!(radius >= 0)) throw std::runtime_error("the radius is negative");
  for (const Block& b : blocks) {
    const double length = distance(b.from, b.to);
    if (!(length > 0) || !(b.width >= 0)) throw std::runtime_error("a wall has no length, or a negative width");
    frames_.push_back({{(b.from.x + b.to.x) / 2, (b.from.y + b.to.y) / 2},
                       {(b.to.x - b.from.x) / length, (b.to.y - b.from.y) / length},
                       length / 2,
                       b.width / 2});
  }
}

double Obstacles::depth(const Point& p) const {
  double deepest = 0;
  for (const Frame& f : frames_) {
    const Point at = f.local(p);
    const double inside = std::min(f.half_length + radius_ - std::abs(at.x), f.half_width + radius_ - std::abs(at.y));
    deepest = std::max(deepest, inside);
  }
  return deepest > touch ? deepest : 0;
}

double Obstacles::clearance(const Point& p) const {
  double nearest = infinite;
  for (const Frame& f : frames_) {
    const Point at = f.local(p);
    nearest = std::min(nearest, std::hypot(std::max(0.0, std::abs(at.x) - f.half_length),
                                           std::max(0.0, std::abs(at.y) - f.half_width)));
  }
  return nearest;
}

bool Obstacles::is_free(const Point& p, double give) const { return depth(p) <= give; }

bool Obstacles::is_free(const Point& a, const Point& b, double give) const {
  return std::none_of(frames_.begin(), frames_.end(),
                      [&](const Frame& f) { return f.is_crossed(a, b, radius_ - give); });
}

std::vector<Corner> Obstacles::corners() const {
  std::vector<Corner> result;
  for (std::size_t own = 0; own < frames_.size(); ++own) {
    const Frame& f = frames_[own];
    const double length = f.half_length + radius_, width = f.half_width + radius_;
    for (const auto& [u, v] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
      const Point along{u * f.axis.x, u * f.axis.y}, across{-v * f.axis.y, v * f.axis.x};
      const Point at{f.middle.x + length * along.x + width * across.x,
                     f.middle.y + length * along.y + width * across.y};
      bool kept = std::none_of(result.begin(), result.end(),
                               [&](const Corner& other) { return distance(other.at, at) <= touch; });
      for (std::size_t i = 0; kept && i < frames_.size(); ++i) {
        if (i == own) continue;
        const Point there = frames_[i].local(at);
        const double x = frames_[i].half_length + radius_ - std::abs(there.x);
        const double y = frames_[i].half_width + radius_ - std::abs(there.y);
        // In the rectangle or on a side of it; at its own corner it stays.
        kept = x < -touch || y < -touch || (x <= touch && y <= touch);
      }
      if (kept) result.push_back({at, along, across});
    }
  }
  return result;
}

Obstacles::Span Obstacles::covered(std::size_t block, double y) const {
  const Frame& f = frames_[block];
  // Along x, a point of the line moves by axis.x along the block and by -axis.y across it.
  const Point start = f.local({0, y});
  double from = -infinite, to = infinite;
  clip(start.x, f.axis.x, f.half_length + radius_, from, to);
  if (from < to) clip(start.y, -f.axis.y, f.half_width + radius_, from, to);
  return {from, to};
}

}  // namespace muster::roadmap
