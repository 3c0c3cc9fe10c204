// Shadowing as a field over the places of both ends, independent of the space between them: correlated as exp(-moved /
// D) for each end. Gudmundson, Correlation model for shadow fading in mobile radio systems, Electronics Letters 27(23),
// 1991, for a link whose ends both move.
#pragma once

#include <array>
#include <cmath>
#include <muster/random.hpp>

namespace muster {

class PerEndField {
 public:
  static constexpr std::size_t waves = 64;

  struct Place {
    double x, y, z;  // decorrelation distances
  };
  // A point as each wave's phasor there: as the first end of a link and as the second.
  struct End : Place {
    std::array<double, waves> first_re, first_im, second_re, second_im;
  };

  explicit PerEndField(const Stream& random) {
    for (std::size_t m = 0; m < waves; ++m) {
      first_[m] = wave(random.of(2 * m), 6.283185307179586 * random.uniform(m));
      second_[m] = wave(random.of(2 * m + 1), 0);
    }
  }

  End end_at(double x, double y, double z) const {
    End result{{x, y, z}, {}, {}, {}, {}};
    for (std::size_t m = 0; m < waves; ++m) {
      const double first = first_[m].at(x, y, z), second = second_[m].at(x, y, z);
      result.first_re[m] = std::cos(first), result.first_im[m] = std::sin(first);
      result.second_re[m] = std::cos(second), result.second_im[m] = std::sin(second);
    }
    return result;
  }

  // Normal, of mean 0 and variance 1; bit for bit the same both ways.
  static double between(const End& p, const End& q) {
    double sum = 0;
    for (std::size_t m = 0; m < waves; ++m) {
      const double one = p.first_re[m] * q.second_re[m] - p.first_im[m] * q.second_im[m];
      const double other = q.first_re[m] * p.second_re[m] - q.first_im[m] * p.second_im[m];
      sum += one + other;
    }
    return sum / std::sqrt(waves * (1 + std::exp(-2 * distance(p, q))));
  }

  // Correlation of two links: over both pairings of their ends.
  static double correlation(const Place& p, const Place& q, const Place& u, const Place& v) {
    const double together = std::exp(-distance(p, u) - distance(q, v)) + std::exp(-distance(p, v) - distance(q, u));
    return together / std::sqrt((1 + std::exp(-2 * distance(p, q))) * (1 + std::exp(-2 * distance(u, v))));
  }

 private:
  struct Wave {
    double x, y, z, phase;  // rad a decorrelation distance; rad
    double at(double px, double py, double pz) const { return x * px + y * py + z * pz + phase; }
  };

  // The spectrum of exp(-r) in space is Cauchy's: a normal vector divided by the magnitude of another normal.
  static Wave wave(const Stream& random, double phase) {
    const double size = std::abs(random.normal(3));
    return {random.normal(0) / size, random.normal(1) / size, random.normal(2) / size, phase};
  }

  static double distance(const Place& a, const Place& b) {
    const double x = a.x - b.x, y = a.y - b.y, z = a.z - b.z;
    return std::sqrt(x * x + y * y + z * z);
  }

  std::array<Wave, waves> first_, second_;
};

}  // namespace muster
