// Shadowing as what a link picks up of one loss field that fills the environment: symmetric, without state, the same on
// return, and correlated between links that run close to one another.
//
// Agrawal and Patwari, Correlated link shadow fading in multi-hop wireless networks, IEEE Trans. Wireless Comm. 8(8),
// 2009: a link's shadowing is the field's line integral over the square root of the link's length. Here the field is a
// sum of plane waves, whose line integrals have a closed form. Its correlation is exp(-r / decorrelation) in every
// direction.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <muster/random.hpp>

#include "even_points.hpp"
#include "widest.hpp"

namespace muster {

class ShadowField {
 public:
  static constexpr std::size_t waves = 64;
  static constexpr std::size_t batch = 8;  // links that are summed side by side

  // A point, in decorrelation distances, and each wave's sine there.
  struct End {
    double x, y, z;
    std::array<double, waves> sine;
  };

  explicit ShadowField(const Stream& random) {
    const std::array<double, 3> shift{random.uniform(0, 1), random.uniform(1, 1), random.uniform(2, 1)};
    for (std::size_t m = 0; m < waves; ++m) {
      const auto [size, height, turn] = even_point(m, shift);
      const double number = wave_number(size), up = 2 * height - 1, along = std::sqrt(1 - up * up);
      x_[m] = number * along * std::cos(full_turn * turn);
      y_[m] = number * along * std::sin(full_turn * turn);
      z_[m] = number * up;
      phase_[m] = full_turn * random.uniform(m);
    }
  }

  End end_at(double x, double y, double z) const {
    End result{x, y, z, {}};
    for (std::size_t m = 0; m < waves; ++m) result.sine[m] = std::sin(phase(m, x, y, z));
    return result;
  }

  // Normal, of mean 0 and the variance below. Bit for bit the same both ways: every difference changes its sign alone.
  double between(const End& p, const End& q) const {
    const End *from = &p, *to = &q;
    double result;
    Links<1>::run(this, &from, &to, &result);
    return result;
  }

  // The same for a batch of links.
  void between(const End* const* p, const End* const* q, double* out) const {
    Widest<Links<batch>, const ShadowField*, const End* const*, const End* const*, double*>::run(this, p, q, out);
  }

  // Of a link of this length: grows to 1 for links much longer than a decorrelation distance.
  static double variance(double length) { return length > 0 ? 1 + std::expm1(-length) / length : 0; }

 private:
  static constexpr double across = 1e-3;  // rad; a wave that turns less along a link is taken by its series
  static constexpr double full_turn = 6.283185307179586;

  // The inverse of the spectrum's distribution function. exp(-r) has in space the spectral density 1 / (1 + k^2)^2, so
  // with k = tan(a) the share of waves below k is (2 a - sin 2 a) / pi.
  static double wave_number(double share) {
    double low = 0, high = full_turn / 4;
    for (int round = 0; round < 60; ++round) {
      const double middle = (low + high) / 2;
      (2 * middle - std::sin(2 * middle) < full_turn / 2 * share ? low : high) = middle;
    }
    return std::tan((low + high) / 2);
  }

  double phase(std::size_t m, double x, double y, double z) const {
    return x_[m] * x + y_[m] * y + z_[m] * z + phase_[m];
  }
  double middle(std::size_t m, const End& p, const End& q) const {
    return std::cos(phase(m, (p.x + q.x) / 2, (p.y + q.y) / 2, (p.z + q.z) / 2));
  }

  // Loops without a branch, which the compiler makes vectors of; each link is summed in the order of the waves.
  template <std::size_t links>
  struct Links {
    [[gnu::always_inline]] static void run(const ShadowField* field, const End* const* p, const End* const* q,
                                           double* out) {
      double part[links][waves];
      for (std::size_t i = 0; i < links; ++i) field->parts(*p[i], *q[i], part[i]);
      double sum[links] = {};
      for (std::size_t m = 0; m < waves; ++m) {
        for (std::size_t i = 0; i < links; ++i) sum[i] += part[i][m];
      }
      for (std::size_t i = 0; i < links; ++i) {
        const double x = q[i]->x - p[i]->x, y = q[i]->y - p[i]->y, z = q[i]->z - p[i]->z;
        out[i] = sum[i] * std::sqrt(std::sqrt(x * x + y * y + z * z) / waves);
      }
    }
  };

  // What each wave adds, but for the length.
  [[gnu::always_inline]] void parts(const End& p, const End& q, double* part) const {
    const double x = q.x - p.x, y = q.y - p.y, z = q.z - p.z;
    double along[waves];
    std::int64_t slow = 0;
    for (std::size_t m = 0; m < waves; ++m) along[m] = x_[m] * x + y_[m] * y + z_[m] * z;
    for (std::size_t m = 0; m < waves; ++m) {
      part[m] = (q.sine[m] - p.sine[m]) / (std::abs(along[m]) > across ? along[m] : across);
      slow += std::abs(along[m]) > across ? 0 : 1;
    }
    for (std::size_t m = 0; slow > 0; ++m) {
      if (std::abs(along[m]) > across) continue;
      part[m] = middle(m, p, q) * (1 - along[m] * along[m] / 24);
      --slow;
    }
  }

  std::array<double, waves> x_, y_, z_, phase_;
};

}  // namespace muster
