// A room full of things: whoever is in it is heard less.
#include <muster/plugin.hpp>

#include "link_term.hpp"
#include "plan_shapes.hpp"

namespace {

using namespace muster;

struct RoomClutter {
  static constexpr auto id = "effect.room_clutter/1";
  static constexpr auto summary = "links into a cluttered room lose more";
  static constexpr auto manual =
      "Takes away `loss` of every link with an end in the rectangle about (x, y), its length along `heading`; once, "
      "where both are.";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {
      real("x", 0, -1e6, 1e6, "m", "middle, east").required().free().with(MUSTER_EAST),
      real("y", 0, -1e6, 1e6, "m", "middle, north").required().free().with(MUSTER_NORTH),
      real("length", 4, 0.1, 1e3, "m", "along the heading").free().with(MUSTER_LOG),
      real("width", 4, 0.1, 1e3, "m", "across the heading").free().with(MUSTER_LOG),
      real("heading", 0, -3.141592653589793, 3.141592653589793, "rad", "of its length, from east to north")
          .with(MUSTER_CYCLIC),
      real("loss", 0, -40, 40, "dB", "of a link with an end in it").free().with(MUSTER_LINEAR),
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
  };

  explicit RoomClutter(Setup& s)
      : x(s.value("x")),
        y(s.value("y")),
        length(s.value("length")),
        width(s.value("width")),
        heading(s.value("heading")),
        loss(s.value("loss")),
        links(s) {}

  void step(const Step& k) const {
    const Rectangle room{k[x], k[y], k[length], k[width], k[heading]};
    links.add(k, [&](const End& a, const End& b) { return room.holds(a.at) || room.holds(b.at) ? -k[loss] : 0; });
  }

  Value x, y, length, width, heading, loss;
  LinkTerm links;
};

}  // namespace

MUSTER_PLUGIN_IS(RoomClutter)
