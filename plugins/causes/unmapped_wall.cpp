// A wall missing from the map.
#include <muster/plugin.hpp>
#include <muster/widest.hpp>

#include "link_term.hpp"
#include "plan_shapes.hpp"

namespace {

using namespace muster;

struct UnmappedWall {
  static constexpr auto id = "effect.unmapped_wall/1";
  static constexpr auto summary = "a wall that is not on the map";
  static constexpr auto manual =
      "Takes away `loss` of every link that crosses the upright wall from (x0, y0) to (x1, y1), which stands on the "
      "ground (z = 0). Waves go around its ends: over `edge` metres along the wall, half of them beyond an end, the "
      "loss "
      "rises from nothing to all of it. With an edge of 0 it is the same as a wall element there. A diagnosis holds "
      "`height`: at its default, outdoors above all radios.";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {
      real("x0", 0, -1e6, 1e6, "m", "first end, east").required().free().with(MUSTER_EAST),
      real("y0", 0, -1e6, 1e6, "m", "first end, north").required().free().with(MUSTER_NORTH),
      real("x1", 0, -1e6, 1e6, "m", "second end, east").required().free().with(MUSTER_EAST),
      real("y1", 0, -1e6, 1e6, "m", "second end, north").required().free().with(MUSTER_NORTH),
      real("loss", 0, 0, 40, "dB", "of a link that crosses it").free().with(MUSTER_LINEAR),
      real("edge", 0, 0, 1, "m", "over which the loss rises at an end").free(),
      real("height", 2.7, 0.01, 1e4, "m", "up to which it reaches"),
  };
  static constexpr muster_cause cause = {
      sizeof(muster_cause),
      MUSTER_TERM,
      "a wall that is not on the map, from ({x0}, {y0}) to ({x1}, {y1}), costs {loss}",
      "",
      places_in_plan,
      "effect.obstacle effect.room_clutter effect.wall_material effect.antenna_tx",
      "cross the place from both sides and towards a second transmitter",
      nullptr,
      0,
  };

  explicit UnmappedWall(Setup& s)
      : x0(s.value("x0")),
        y0(s.value("y0")),
        x1(s.value("x1")),
        y1(s.value("y1")),
        loss(s.value("loss")),
        edge(s.value("edge")),
        height(s.value("height")),
        links(s) {}

  void step(const Step& k) const {
    const Segment wall{k[x0], k[y0], k[x1], k[y1]};
    const double most = -k[loss], up_to = k[height], over = k[edge];
    using Meets = Widest<MeetsSegment, const PlanEnds&, std::size_t, const Segment&, double, double*>;
    links.add_both_ways(
        k, most * 0,
        [&](const PlanEnds& ends, std::size_t count, double* met) { Meets::run(ends, count, wall, over, met); },
        [&](const End& a, const End& b) { return most * wall.share(a.at, b.at, up_to, over); });
  }

  Value x0, y0, x1, y1, loss, edge, height;
  LinkTerm links;
};

}  // namespace

MUSTER_PLUGIN_IS(UnmappedWall)
