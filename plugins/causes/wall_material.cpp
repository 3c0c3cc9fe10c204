// A wall of another material than on the map.
#include <muster/plugin.hpp>

#include "link_term.hpp"
#include "wall_term.hpp"

namespace {

using namespace muster;

struct WallMaterial {
  static constexpr auto id = "effect.wall_material/1";
  static constexpr auto summary = "a wall loses more or less than its material says";
  static constexpr auto manual =
      "Takes away `change` for every crossing of `wall`. Its doors are not of its material: they count neither open "
      "nor closed.";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr bool keeps_only_caches = true;
  static constexpr Param params[] = {
      reference("wall", "wall", "which wall").required(),
      real("change", 0, -40, 40, "dB", "loss beyond that of its material").free().with(MUSTER_LINEAR),
  };
  static constexpr muster_cause cause = {
      sizeof(muster_cause),
      MUSTER_TERM,
      "the wall {wall} loses {change|more|less} than its material says",
      "wall",
      places_in_plan,
      "effect.wall_absent effect.unmapped_wall effect.obstacle effect.room_clutter",
      "measure straight through the wall, close to it, from both sides",
      nullptr,
      0,
  };

  explicit WallMaterial(Setup& s) : wall(s.value("wall")), change(s.value("change")), walls(s, wall) {}

  void step(const Step& k) {
    walls.add(k, [&](const scene::Crossing& it, double) { return it.door < 0 ? -k[change] : 0; });
  }

  Value wall, change;
  WallTerm walls;
};

}  // namespace

MUSTER_PLUGIN_IS(WallMaterial)
