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
#include "widest.hpp"

namespace muster {

class Multipath {
 public:
  static constexpr std::size_t waves = 32;
  static constexpr std::size_t batch = 8;  // links that are summed side by side

  // A point as each wave's phasor there, leaving (k) and arriving (l).
  struct End {
    std::array<double, waves> leaving_re, leaving_im, arriving_re, arriving_im;
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
      const double leaving = phase(leaving_[m], x, y, z), arriving = phase(arriving_[m], x, y, z);
      result.leaving_re[m] = std::cos(leaving), result.leaving_im[m] = std::sin(leaving);
      result.arriving_re[m] = std::cos(arriving), result.arriving_im[m] = std::sin(arriving);
    }
    return result;
  }

  // Nearly complex normal, of mean 0 and mean power 1 over places. Bit for bit the same both ways.
  std::complex<double> between(const End& p, const End& q) const {
    const End *from = &p, *to = &q;
    std::complex<double> result;
    Links<1>::run(&from, &to, &result);
    return result;
  }

  // The same for a batch of links.
  void between(const End* const* p, const End* const* q, std::complex<double>* out) const {
    Widest<Links<batch>, const End* const*, const End* const*, std::complex<double>*>::run(p, q, out);
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

  static double phase(const Wave& w, double x, double y, double z) { return w.x * x + w.y * y + w.z * z + w.phase; }

  // Loops without a branch, which the compiler makes vectors of; each link is summed in the order of the waves.
  template <std::size_t links>
  struct Links {
    [[gnu::always_inline]] static void run(const End* const* p, const End* const* q, std::complex<double>* out) {
      double re[links][waves], im[links][waves];
      for (std::size_t i = 0; i < links; ++i) {
        for (std::size_t m = 0; m < waves; ++m) {
          const double a_re = p[i]->leaving_re[m], a_im = p[i]->leaving_im[m];
          const double b_re = q[i]->arriving_re[m], b_im = q[i]->arriving_im[m];
          const double c_re = q[i]->leaving_re[m], c_im = q[i]->leaving_im[m];
          const double d_re = p[i]->arriving_re[m], d_im = p[i]->arriving_im[m];
          re[i][m] = (a_re * b_re - a_im * b_im) + (c_re * d_re - c_im * d_im);
          im[i][m] = (a_re * b_im + a_im * b_re) + (c_re * d_im + c_im * d_re);
        }
      }
      double sum_re[links] = {}, sum_im[links] = {};
      for (std::size_t m = 0; m < waves; ++m) {
        for (std::size_t i = 0; i < links; ++i) sum_re[i] += re[i][m], sum_im[i] += im[i][m];
      }
      for (std::size_t i = 0; i < links; ++i) {
        out[i] = std::complex<double>(sum_re[i], sum_im[i]) * std::sqrt(0.5 / waves);
      }
    }
  };

  std::array<Wave, waves> leaving_, arriving_;
};

}  // namespace muster
