// Small-scale fading by plane waves that all radios share, so that it is a function of place: symmetric, without state,
// repeatable, constant while nothing moves, with the Doppler spectrum of the motion otherwise.
//
// Each end's waves come from all around, as in Clarke, A statistical theory of mobile-radio reception, Bell Syst. Tech.
// J. 47 (1968): the complex gain of a link decorrelates as J0(2 pi s / wavelength) when one end moves by s over the
// ground. A small spread in elevation (Aulin 1979) makes it change with height too.
#pragma once

#include <cmath>
#include <complex>
#include <muster/random.hpp>

#include "tiles.hpp"

namespace muster {

class Multipath {
 public:
  using Tile = waves::FadingTile;

  explicit Multipath(const Stream& random);

  // Precomputed values of the ends; places in wavelengths.
  std::vector<Tile> at(const std::vector<FieldPoint>& places,
                       const waves::WaveKernel& kernel = waves::best_wave_kernel()) const;

  // Power gains of mean 1 from a place of one tile to the wanted ones of another. The steady part is K times as strong
  // as the diffuse one. Bit for bit the same both ways.
  void gains(const Tile& from, int place, const Tile& to, unsigned wanted, double k, double* out,
             const waves::WaveKernel& kernel = waves::best_wave_kernel()) const {
    double re[waves::tile], im[waves::tile];
    kernel.fading(from, place, to, wanted, re, im);
    kernel.power(from.at, place, to.at, std::sqrt(k / (k + 1)), std::sqrt(1 / (k + 1)), re, im, out);
  }

  // The diffuse part of one link: nearly complex normal, of mean 0 and mean power 1 over places.
  std::complex<double> between(const FieldPoint& p, const FieldPoint& q) const;

 private:
  waves::FadingWaves waves_;
};

}  // namespace muster
