// Two-ray model: reflection from the ground, or a floor.
#include <algorithm>
#include <cmath>
#include <muster/plugin.hpp>

#include "link_term.hpp"

namespace {

using namespace muster;

struct TwoRay {
  static constexpr auto id = "effect.two_ray/2";
  static constexpr auto summary = "a wave reflected by the ground interferes with the direct one";
  static constexpr auto manual =
      "Adds 20 log10 |1 + R (d / e) exp(-i 2 pi (e - d) / wavelength)|, d the length of the link and e that of the way "
      "by the mirror in the ground. R = reflection x (eps sin a - q) / (eps sin a + q), q = sqrt(eps - cos^2 a): "
      "Fresnel's reflection of an upright field by a dielectric ground, a being the angle between it and the wave. It "
      "is -1 at a flat angle and changes its sign at Brewster's. Rappaport, Wireless communications (2002), sections "
      "4.5 and 4.6; ITU-R P.527 lists grounds.";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {
      real("reflection", 0, 0, 1, "", "share of amplitude that the ground's roughness leaves").free(),
      real("permittivity", 5, 1.5, 100, "",
           "of the ground against that of air: 3 for dry soil and wood, 5 to 8 for concrete")
          .free()
          .with(MUSTER_LOG),
      real("ground", 0, -1e6, 1e6, "m", "height of the mirror"),
      real("frequency", 2.44e9, 1e6, 1e12, "Hz", "carrier").free().with(MUSTER_LOG),
  };
  static constexpr muster_cause cause = {
      sizeof(muster_cause),
      MUSTER_TERM,
      "the ground of permittivity {permittivity} reflects a share of {reflection} of what a smooth one would",
      "",
      "tx_z rx_z",
      "effect.dual_slope effect.corridor effect.height",
      "measure along a line in the open: it goes up and down, and otherwise with another height of the antenna",
      nullptr,
      0,
  };

  explicit TwoRay(Setup& s)
      : reflection(s.value("reflection")),
        permittivity(s.value("permittivity")),
        ground(s.value("ground")),
        frequency(s.value("frequency")),
        links(s) {}

  void step(const Step& k) const {
    const double wavelength = 299792458 / k[frequency];  // m
    links.add_both_ways(k, [&](const End& a, const End& b) {
      const double direct = distance(a, b), up_a = a.at.z - k[ground], up_b = b.at.z - k[ground];
      const double mirrored = std::sqrt(std::max(direct * direct + 4 * up_a * up_b, 1e-4));
      const double share = k[reflection] * fresnel(std::abs(up_a + up_b) / mirrored, k[permittivity]);
      const double amplitude = share * direct / mirrored, behind = full_turn * (mirrored - direct) / wavelength;
      return 10 * std::log10(std::max(1 + amplitude * amplitude + 2 * amplitude * std::cos(behind), 1e-12));
    });
  }

  // Fresnel coefficient of a field in the plane of incidence; `sine` is that of the angle to the ground.
  static double fresnel(double sine, double permittivity) {
    const double inside = std::sqrt(permittivity - 1 + std::min(sine * sine, 1.0));
    return (permittivity * sine - inside) / (permittivity * sine + inside);
  }

  Value reflection, permittivity, ground, frequency;
  LinkTerm links;
};

}  // namespace

MUSTER_PLUGIN_IS(TwoRay)
