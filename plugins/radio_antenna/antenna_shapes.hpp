// Antennas with a formula: gain in a direction relative to that along the lobe, in dB.
#pragma once

#include <limits>

#include "direction.hpp"

namespace muster {

constexpr double nothing = -std::numeric_limits<double>::infinity();  // dB

// Half a wavelength of wire along z, thin and centre-fed (Balanis, Antenna Theory, section 4.6).
inline double dipole_shape(const Direction& d) {
  const double across = 1 - d.z * d.z;  // squared sine of the angle to the wire
  if (across <= 0) return nothing;
  const double field = std::cos(half_turn / 2 * d.z);
  return 10 * std::log10(field * field / across);
}

// Power is a power of the cosine of the angle off the lobe, with none to the back; at half the beamwidth [rad] it is
// halved.
inline double cosine_shape(const Direction& d, double beamwidth) {
  const double order = std::log(0.5) / std::log(std::cos(beamwidth / 2));
  return d.x > 0 ? 10 * order * std::log10(d.x) : nothing;
}

// The sector of 3GPP TR 36.814, table A.2.1.1-2: parabolas in dB over azimuth and elevation, down to `depth` at most.
// Beamwidths at half power [rad].
inline double sector_shape(const Direction& d, double beamwidth, double beamwidth_up, double depth) {
  const double aside = azimuth(d) / beamwidth, up = elevation(d) / beamwidth_up;
  return -std::min(12 * aside * aside, depth) - std::min(12 * up * up, depth);
}

}  // namespace muster
