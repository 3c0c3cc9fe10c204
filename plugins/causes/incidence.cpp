// Greater loss of walls crossed at a slant.
#include <algorithm>
#include <muster/plugin.hpp>

#include "link_term.hpp"
#include "wall_term.hpp"

namespace {

using namespace muster;

struct Incidence {
  static constexpr auto id = "effect.incidence/1";
  static constexpr auto summary = "walls that are crossed at a slant cost more";
  static constexpr auto manual =
      "Takes away share x L x (1 / cos a - 1) for every wall crossed, L being its loss and a the angle between link "
      "and normal, in three dimensions: with share 1 the loss grows as the way through it. The bracket is at most "
      "`most`: very flat links find another way. A diagnosis holds `most` at its default.";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr bool keeps_only_caches = true;
  static constexpr Param params[] = {
      real("share", 0, -1, 4, "", "of the loss that grows as the way through the wall").free().with(MUSTER_LINEAR),
      real("most", 3, 0, 100, "", "bound of 1 / cos a - 1"),
  };
  static constexpr muster_cause cause = {
      sizeof(muster_cause),
      MUSTER_TERM,
      "walls crossed at a slant cost more: a share of {share} of their loss grows as the way through them",
      "",
      places_in_plan,
      "effect.multiwall_saturation effect.dual_slope effect.corridor",
      "cross one wall straight and at 60 degrees, at the same distance",
      nullptr,
      0,
  };

  explicit Incidence(Setup& s) : share(s.value("share")), most(s.value("most")), walls(s) {}

  void step(const Step& k) {
    walls.add(k, [&](const scene::Crossing& it, double loss) {
      return -k[share] * loss * std::min(1 / it.cos_incidence - 1, k[most]);
    });
  }

  Value share, most;
  WallTerm walls;
};

}  // namespace

MUSTER_PLUGIN_IS(Incidence)
