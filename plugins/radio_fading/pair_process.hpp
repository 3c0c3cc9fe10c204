// Shadowing and fading of a pair of radios as first-order autoregressive processes along their paths, as in network
// simulators.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <muster/random.hpp>
#include <muster/tables.hpp>

namespace muster {

// Correlation that remains after the ends have moved by a and b.
inline double shadowing_left(double a, double b, double decorrelation) { return std::exp(-(a + b) / decorrelation); }
inline double fading_left(double a, double b, double wavelength) {  // Akki and Haber 1986
  const double turn = 6.283185307179586 / wavelength;
  return std::cyl_bessel_j(0, turn * a) * std::cyl_bessel_j(0, turn * b);
}

// Factor of a new draw that keeps the variance. A correlation may be rounded beyond one.
inline double rest(double left) { return std::sqrt(std::max(0.0, 1 - left * left)); }

// The state of a pair, kept from tick to tick: doubles only.
struct PairProcess {
  struct Place {
    double x, y, z;
    double to(const Pose& p) const {
      return std::sqrt((p.x - x) * (p.x - x) + (p.y - y) * (p.y - y) + (p.z - z) * (p.z - z));
    }
  };

  double low, high;  // the radios' rows, low < high
  Place at_low, at_high;
  double moves;   // so far: index of the next draw
  double shadow;  // normal, of variance 1
  double re, im;  // complex normal, of mean power 1

  // Advances to the radios' present places. `random` is the pair's own. Where neither has moved, nothing changes.
  void follow(const Pose& now_low, const Pose& now_high, double decorrelation, double wavelength,
              const Stream& random) {
    const double a = moves > 0 ? at_low.to(now_low) : 0, b = moves > 0 ? at_high.to(now_high) : 0;
    if (moves > 0 && a == 0 && b == 0) return;
    const double of_shadow = moves > 0 ? shadowing_left(a, b, decorrelation) : 0;
    const double of_fading = moves > 0 ? fading_left(a, b, wavelength) : 0;
    const auto draw = static_cast<uint64_t>(moves);
    shadow = of_shadow * shadow + rest(of_shadow) * random.normal(draw, 0);
    const double fresh = rest(of_fading) * std::sqrt(0.5);
    re = of_fading * re + fresh * random.normal(draw, 1);
    im = of_fading * im + fresh * random.normal(draw, 2);
    at_low = {now_low.x, now_low.y, now_low.z};
    at_high = {now_high.x, now_high.y, now_high.z};
    ++moves;
  }

  std::complex<double> diffuse() const { return {re, im}; }
};

}  // namespace muster
