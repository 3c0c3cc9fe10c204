// A cluttered room: links into it lose more.
#include <cmath>
#include <muster/plugin.hpp>

#include "link_term.hpp"
#include "plan_shapes.hpp"

namespace {

using namespace muster;

struct RoomClutter {
  static constexpr auto id = "effect.room_clutter/2";
  static constexpr auto summary = "links into a cluttered room lose more";
  static constexpr auto manual =
      "Takes away loss (1 - exp(-w / depth)) of every link with an end in the rectangle about (x, y), its length along "
      "`heading`; w is the link's way inside it in plan. Clutter about an end takes more the further a wave has to "
      "come "
      "through it, and not beyond a bound (ITU-R P.833, section 2.1); an end above the things, at `height` or higher, "
      "is "
      "not among them (P.2108). A diagnosis holds `heading` at the direction of the plan's walls.";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {
      real("x", 0, -1e6, 1e6, "m", "middle, east").required().free().with(MUSTER_EAST),
      real("y", 0, -1e6, 1e6, "m", "middle, north").required().free().with(MUSTER_NORTH),
      real("length", 4, 0.1, 1e4, "m", "along the heading").free().with(MUSTER_LOG),
      real("width", 4, 0.1, 1e4, "m", "across the heading").free().with(MUSTER_LOG),
      real("heading", 0, -3.141592653589793, 3.141592653589793, "rad", "of its length, from east to north")
          .with(MUSTER_CYCLIC),
      real("depth", 0.8, 0.05, 1e3, "m", "way inside on which all but 37 % of the loss is met").free().with(MUSTER_LOG),
      real("height", 2.7, 0.01, 1e4, "m", "up to which things stand").free(),
      real("loss", 0, -40, 40, "dB", "of a link that goes far inside it").free().with(MUSTER_LINEAR),
  };
  static constexpr muster_cause cause = {
      sizeof(muster_cause),
      MUSTER_TERM,
      "links into the room about ({x}, {y}) lose {loss} more",
      "",
      places_in_plan,
      "effect.unmapped_wall effect.obstacle effect.wall_material effect.tx_offset",
      "measure in the room next to each of its walls and in its middle, from two transmitters",
      nullptr,
      0,
  };

  explicit RoomClutter(Setup& s)
      : x(s.value("x")),
        y(s.value("y")),
        length(s.value("length")),
        width(s.value("width")),
        heading(s.value("heading")),
        depth(s.value("depth")),
        height(s.value("height")),
        loss(s.value("loss")),
        links(s) {}

  void step(const Step& k) const {
    const Rectangle room{k[x], k[y], k[length], k[width], k[heading]};
    const auto among = [&](const Pose& p) { return p.z < k[height] && room.holds(p); };
    links.add_both_ways(k, [&](const End& a, const End& b) {
      if (!among(a.at) && !among(b.at)) return 0.0;
      return k[loss] * std::expm1(-room.way(a.at, b.at) / k[depth]);
    });
  }

  Value x, y, length, width, heading, depth, height, loss;
  LinkTerm links;
};

}  // namespace

MUSTER_PLUGIN_IS(RoomClutter)
