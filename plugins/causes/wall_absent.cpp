// A wall of the map that is absent.
#include <muster/plugin.hpp>

#include "link_term.hpp"
#include "wall_term.hpp"

namespace {

using namespace muster;

struct WallAbsent {
  static constexpr auto id = "effect.wall_absent/1";
  static constexpr auto summary = "a wall that the map has is not there, or not all of it";
  static constexpr auto manual =
      "Gives back `share` of what each crossing of `wall` costs, closed doors in it included at their own loss: 1 "
      "where nothing is left of it.";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr bool keeps_only_caches = true;
  static constexpr Param params[] = {
      reference("wall", "wall", "which wall").required(),
      real("share", 0, 0, 1, "", "of its loss that is not there").free().with(MUSTER_LINEAR),
  };
  static constexpr muster_cause cause = {
      sizeof(muster_cause),
      MUSTER_TERM,
      "of the wall {wall} a share of {share} is not there",
      "wall",
      places_in_plan,
      "effect.wall_material",
      "look; or measure straight through the wall, close to it, from both sides",
      nullptr,
      0,
  };

  explicit WallAbsent(Setup& s) : wall(s.value("wall")), share(s.value("share")), walls(s, wall) {}

  void step(const Step& k) {
    walls.add(k, [&](const scene::Crossing&, double loss) { return k[share] * loss; });
  }

  Value wall, share;
  WallTerm walls;
};

}  // namespace

MUSTER_PLUGIN_IS(WallAbsent)
