#include "line_integral.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace muster {
namespace {

constexpr double far = 14;  // decorrelation distances beyond which exp(-r) counts as 0

// The integral of exp(-sqrt(rho^2 + u^2)) over u from 0 to x, from a table. Odd in x.
class HalfLine {
 public:
  HalfLine() : values_(static_cast<std::size_t>(rows) * columns) {
    for (int i = 0; i < rows; ++i) {
      const double rho = i * step;
      double sum = 0;
      for (int j = 1; j < columns; ++j) {
        // Simpson's rule on each cell.
        const auto at = [&](double x) { return std::exp(-std::hypot(rho, x)); };
        sum += step / 6 * (at((j - 1) * step) + 4 * at((j - 0.5) * step) + at(j * step));
        values_[static_cast<std::size_t>(i) * columns + static_cast<std::size_t>(j)] = static_cast<float>(sum);
      }
    }
  }

  double operator()(double rho, double x) const {
    // One column and row more than `far` takes, so that its own cell is there.
    const float along = static_cast<float>(std::min(std::abs(x), far) * per_step);
    const float across = static_cast<float>(std::min(rho, far) * per_step);
    const int i = static_cast<int>(across), j = static_cast<int>(along);
    const float u = across - static_cast<float>(i), v = along - static_cast<float>(j);
    const float* const at = values_.data() + i * columns + j;
    const float low = at[0] + v * (at[1] - at[0]), high = at[columns] + v * (at[columns + 1] - at[columns]);
    return std::copysign(static_cast<double>(low + u * (high - low)), x);
  }

 private:
  static constexpr double step = 1.0 / 32, per_step = 32;
  static constexpr int rows = static_cast<int>(far / step) + 2, columns = rows;

  std::vector<float> values_;
};

struct Point {
  double x, y, z;

  Point operator-(const Point& o) const { return {x - o.x, y - o.y, z - o.z}; }
  double dot(const Point& o) const { return x * o.x + y * o.y + z * o.z; }
};

// A link in decorrelation distances.
struct Segment {
  Point from, along;  // along: of length 1
  double length;
};

Segment segment_of(const double* ends, double decorrelation) {
  const Point p{ends[0] / decorrelation, ends[1] / decorrelation, ends[2] / decorrelation};
  const Point q{ends[3] / decorrelation, ends[4] / decorrelation, ends[5] / decorrelation};
  const Point way = q - p;
  const double length = std::sqrt(way.dot(way));
  const double scale = length > 0 ? 1 / length : 0;
  return {p, {way.x * scale, way.y * scale, way.z * scale}, length};
}

// Nodes and weights of Gauss and Legendre's rule on [-1, 1], five points.
constexpr std::array<double, 5> nodes{-0.906179845938664, -0.538469310105683, 0, 0.538469310105683, 0.906179845938664};
constexpr std::array<double, 5> weights{0.236926885056189, 0.478628670499366, 0.568888888888889, 0.478628670499366,
                                        0.236926885056189};

double integral(const HalfLine& half_line, const Segment& one, const Segment& other) {
  const Segment &outer = one.length < other.length ? one : other, &inner = one.length < other.length ? other : one;
  const int panels = std::min(1 + static_cast<int>(outer.length / 3), 12);
  const double half = outer.length / panels / 2;
  const Point apart = outer.from - inner.from;
  const double offset = apart.dot(inner.along), slope = outer.along.dot(inner.along);
  const double squared = apart.dot(apart), linear = 2 * apart.dot(outer.along);
  double sum = 0;
  for (int panel = 0; panel < panels; ++panel) {
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const double t = half * (2 * panel + 1 + nodes[k]);
      const double foot = offset + slope * t;
      const double rho2 = squared + t * (linear + t) - foot * foot;
      const double rho = std::sqrt(std::max(rho2, 0.0));
      if (rho > far) continue;
      sum += half * weights[k] * (half_line(rho, inner.length - foot) + half_line(rho, foot));
    }
  }
  return sum;
}

}  // namespace

void covariance_of_line_integrals(double decorrelation, const double* ends, const uint32_t* a, const uint32_t* b,
                                  uint32_t count, double* out) {
  static const HalfLine half_line;
  if (count == 0) return;
  const uint32_t last = std::max(*std::max_element(a, a + count), *std::max_element(b, b + count));
  std::vector<Segment> links;
  for (uint32_t i = 0; i <= last; ++i) links.push_back(segment_of(ends + std::size_t{6} * i, decorrelation));
  for (uint32_t i = 0; i < count; ++i) {
    const Segment &one = links[a[i]], &other = links[b[i]];
    const double scale = 2 * std::sqrt(one.length * other.length);
    if (a[i] == b[i])
      out[i] = one.length > 0 ? 1 + std::expm1(-one.length) / one.length : 0;
    else
      out[i] = scale > 0 ? integral(half_line, one, other) / scale : 0;
  }
}

}  // namespace muster
