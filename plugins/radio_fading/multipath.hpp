// Small-scale fading by plane waves that all radios share, so that it belongs to the place: symmetric, without state,
// the same on return, still while nobody moves, with the Doppler spectrum of the motion otherwise.
//
// Each end's waves come from all around, as in Clarke, A statistical theory of mobile-radio reception, Bell Syst. Tech.
// J. 47 (1968): the complex gain of a link decorrelates as J0(2 pi s / wavelength) when one end moves by s over the
// ground. A small spread in elevation (Aulin 1979) lets it change with height too.
#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <muster/random.hpp>

#include "even_points.hpp"

namespace muster {

class Multipath {
 public:
  static constexpr std::size_t waves = 32;

  // A point as each wave's phasor there, leaving (k) and arriving (l).
  struct End {
    std::array<std::complex<double>, waves> leaving, arriving;
  };

  explicit Multipath(const Stream& random) {
    const std::array<double, 4> shift{random.uniform(0, 1), random.uniform(1, 1), random.uniform(2, 1),
                                      random.uniform(3, 1)};
    for (std::size_t m = 0; m < waves; ++m) {
      const auto [a, b, up_a, up_b] = even_point(m, shift);
      leaving_[m] = wave(a, up_a, full_turn * random.uniform(m));
      arriving_[m] = wave(b, up_b, 0);
    }
  }

  // A point in wavelengths.
  End end_at(double x, double y, double z) const {
    End result;
    for (std::size_t m = 0; m < waves; ++m) {
      result.leaving[m] = phasor(leaving_[m], x, y, z);
      result.arriving[m] = phasor(arriving_[m], x, y, z);
    }
    return result;
  }

  // Nearly complex normal, of mean 0 and mean power 1 over places. Bit for bit the same both ways.
  std::complex<double> between(const End& p, const End& q) const {
    double re = 0, im = 0;
    for (std::size_t m = 0; m < waves; ++m) {
      const auto &a = p.leaving[m], &b = q.arriving[m], &c = q.leaving[m], &d = p.arriving[m];
      re += (a.real() * b.real() - a.imag() * b.imag()) + (c.real() * d.real() - c.imag() * d.imag());
      im += (a.real() * b.imag() + a.imag() * b.real()) + (c.real() * d.imag() + c.imag() * d.real());
    }
    return std::complex<double>(re, im) * std::sqrt(0.5 / waves);
  }

 private:
  struct Wave {
    double x, y, z, phase;  // rad a wavelength; rad
  };
  static constexpr double full_turn = 6.283185307179586;
  static constexpr double highest = 0.17;  // sine of the steepest elevation, 10 degrees

  static Wave wave(double turn, double height, double phase) {
    const double up = highest * (2 * height - 1), along = std::sqrt(1 - up * up);
    return {full_turn * along * std::cos(full_turn * turn), full_turn * along * std::sin(full_turn * turn),
            full_turn * up, phase};
  }

  static std::complex<double> phasor(const Wave& w, double x, double y, double z) {
    const double phase = w.x * x + w.y * y + w.z * z + w.phase;
    return {std::cos(phase), std::sin(phase)};
  }

  std::array<Wave, waves> leaving_, arriving_;
};

}  // namespace muster
