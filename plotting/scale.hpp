// Maps data to pixels.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace muster::plotting {

struct Point {
  double x = 0, y = 0;
};

struct Range {
  double low = 0, high = 1;
  double span() const { return high - low; }
  bool holds(double v) const { return v >= low && v <= high; }
};

// NaN, infinities, and values that would overflow in the difference of a range are not drawn.
inline bool drawable(double v) { return std::abs(v) <= 1e300; }
inline bool drawable(Point p) { return drawable(p.x) && drawable(p.y); }

// The smallest range that contains all drawable values added.
class Extent {
 public:
  void add(double v) {
    if (!drawable(v)) return;
    low_ = std::min(low_, v);
    high_ = std::max(high_, v);
  }
  void add(const Extent& other) {
    low_ = std::min(low_, other.low_);
    high_ = std::max(high_, other.high_);
  }
  bool empty() const { return low_ > high_; }
  Range range() const { return {low_, high_}; }

 private:
  double low_ = std::numeric_limits<double>::infinity();
  double high_ = -std::numeric_limits<double>::infinity();
};

// Maps a range of data to pixels, linearly or by the logarithm; pixel_low may lie above pixel_high (y axes).
class Scale {
 public:
  Scale() = default;
  Scale(Range range, double pixel_low, double pixel_high, bool log = false)
      : range_(range), pixel_low_(pixel_low), pixel_high_(pixel_high), log_(log) {}

  // NaN for values outside the scale's domain: NaN, or not above 0 on a log scale.
  double operator()(double v) const {
    if (!drawable(v) || (log_ && v <= 0)) return std::numeric_limits<double>::quiet_NaN();
    const double at =
        log_ ? std::log(v / range_.low) / std::log(range_.high / range_.low) : (v - range_.low) / range_.span();
    return pixel_low_ + at * (pixel_high_ - pixel_low_);
  }
  const Range& range() const { return range_; }
  bool log() const { return log_; }
  // Pixels per unit of data, on a linear scale.
  double pixels() const { return std::abs(pixel_high_ - pixel_low_) / range_.span(); }

 private:
  Range range_;
  double pixel_low_ = 0, pixel_high_ = 1;
  bool log_ = false;
};

}  // namespace muster::plotting
