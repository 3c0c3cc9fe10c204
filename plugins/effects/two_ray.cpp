// The ground, or a floor, reflects.
#include <algorithm>
#include <cmath>
#include <muster/plugin.hpp>

#include "link_term.hpp"

namespace {

using namespace muster;

struct TwoRay {
  static constexpr auto id = "effect.two_ray/1";
  static constexpr auto summary = "a wave reflected by the ground interferes with the direct one";
  static constexpr auto manual =
      "Adds 20 log10 |1 + R (d / e) exp(-i 2 pi (e - d) / wavelength)|, R = reflection, d the length of the link and "
      "e that of the way by the mirror in the ground. Rappaport, Wireless communications (2002), section 4.6.";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {
      real("reflection", 0, -0.95, 0.95, "", "of the ground, of amplitudes; -1 for a perfect one at a flat angle")
          .free(),
      real("ground", 0, -1e6, 1e6, "m", "height of the mirror"),
      real("frequency", 2.44e9, 1e6, 1e12, "Hz", "carrier"),
  };
  static constexpr muster_cause cause = {
      sizeof(muster_cause),
      MUSTER_TERM,
      "the ground reflects a share of {reflection} of the amplitude",
      "",
      "tx_z rx_z",
      "effect.dual_slope effect.corridor effect.height",
      "measure along a line in the open: it goes up and down, and otherwise with another height of the antenna",
      nullptr,
  };

  explicit TwoRay(Setup& s)
      : reflection(s.value("reflection")), ground(s.value("ground")), frequency(s.value("frequency")), links(s) {}

  void step(const Step& k) const {
    const double wavelength = 299792458 / k[frequency];  // m
    links.add_both_ways(k, [&](const End& a, const End& b) {
      const double direct = distance(a, b), above = 4 * (a.at.z - k[ground]) * (b.at.z - k[ground]);
      const double mirrored = std::sqrt(std::max(direct * direct + above, 1e-4));
      const double share = k[reflection] * direct / mirrored, behind = full_turn * (mirrored - direct) / wavelength;
      return 10 * std::log10(1 + share * share + 2 * share * std::cos(behind));
    });
  }

  Value reflection, ground, frequency;
  LinkTerm links;
};

}  // namespace

MUSTER_PLUGIN_IS(TwoRay)
