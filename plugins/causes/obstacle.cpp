// A single obstacle: a machine, a cabinet, a pillar.
#include <cmath>
#include <muster/plugin.hpp>
#include <muster/widest.hpp>

#include "link_term.hpp"
#include "plan_shapes.hpp"

namespace {

using namespace muster;

struct Obstacle {
  static constexpr auto id = "effect.obstacle/2";
  static constexpr auto summary = "a thing that is not on the map stands in the way of links";
  static constexpr auto manual =
      "Takes away `loss` of a link through the middle of the upright cylinder about (x, y), and of one whose way "
      "through "
      "it in plan is w loss (1 - exp(-w / radius)) / (1 - exp(-2)): what is lost in it grows with the way, and waves "
      "that go around it bound that. It stands on the ground (z = 0). A diagnosis holds `height`: at its default, "
      "outdoors above all radios.";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {
      real("x", 0, -1e6, 1e6, "m", "middle, east").required().free().with(MUSTER_EAST),
      real("y", 0, -1e6, 1e6, "m", "middle, north").required().free().with(MUSTER_NORTH),
      real("radius", 0.5, 0.1, 1e3, "m", "radius").free().with(MUSTER_LOG),
      real("loss", 0, 0, 60, "dB", "of a link through its middle").free().with(MUSTER_LINEAR),
      real("height", 2.7, 0.01, 1e4, "m", "up to which it reaches"),
  };
  static constexpr muster_cause cause = {
      sizeof(muster_cause),
      MUSTER_TERM,
      "a thing of radius {radius} at ({x}, {y}) that is not on the map costs up to {loss}",
      "",
      places_in_plan,
      "effect.unmapped_wall effect.room_clutter effect.antenna_tx effect.wall_material",
      "look; or drive around the place: a wall is seen from two sides only, a thing from all",
      nullptr,
      0,
  };

  explicit Obstacle(Setup& s)
      : x(s.value("x")),
        y(s.value("y")),
        radius(s.value("radius")),
        loss(s.value("loss")),
        height(s.value("height")),
        links(s) {}

  void step(const Step& k) const {
    const Disk thing{k[x], k[y], k[radius]};
    const double most = k[loss], up_to = k[height];
    using Meets = Widest<MeetsDisk, const PlanEnds&, std::size_t, const Disk&, double*>;
    links.add_both_ways(
        k, 0, [&](const PlanEnds& ends, std::size_t count, double* met) { Meets::run(ends, count, thing, met); },
        [&](const End& a, const End& b) {
          const double way = thing.way(a.at, b.at, up_to);
          return way > 0 ? most * std::expm1(-way / thing.radius) / -std::expm1(-2) : 0;
        });
  }

  Value x, y, radius, loss, height;
  LinkTerm links;
};

}  // namespace

MUSTER_PLUGIN_IS(Obstacle)
