// Shadowing as the integral along a link of one loss field that fills the environment: symmetric, without state,
// repeatable, and correlated between links that run close to one another.
//
// Agrawal and Patwari, Correlated link shadow fading in multi-hop wireless networks, IEEE Trans. Wireless Comm. 8(8),
// 2009: a link's shadowing is the field's line integral over the square root of the link's length. Here the field is a
// sum of plane waves, whose line integrals have a closed form. Its correlation is exp(-r / decorrelation) in every
// direction.
#pragma once

#include <cmath>
#include <muster/random.hpp>

#include "tiles.hpp"

namespace muster {

class ShadowField {
 public:
  using Tile = waves::ShadowTile;

  explicit ShadowField(const Stream& random);

  // Precomputed values of the ends; places in decorrelation distances.
  std::vector<Tile> at(const std::vector<FieldPoint>& places,
                       const waves::WaveKernel& kernel = waves::best_wave_kernel()) const;

  // From a place of one tile to the wanted ones of another: normal, of mean 0 and the variance below, times `sd`. Bit
  // for bit the same both ways.
  void between(const Tile& from, int place, const Tile& to, unsigned wanted, double sd, double* out,
               const waves::WaveKernel& kernel = waves::best_wave_kernel()) const {
    kernel.shadow(from, place, to, wanted, sd, out);
  }

  // The same for one link.
  double between(const FieldPoint& p, const FieldPoint& q) const;

  // Variance for a link of this length: grows to 1 for links much longer than a decorrelation distance.
  static double variance(double length) { return length > 0 ? 1 + std::expm1(-length) / length : 0; }

 private:
  waves::PlaneWaves<waves::shadow_waves> waves_;
};

}  // namespace muster
