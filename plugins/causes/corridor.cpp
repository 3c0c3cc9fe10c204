// A corridor as a waveguide.
#include <cmath>
#include <muster/plugin.hpp>

#include "link_term.hpp"
#include "plan_shapes.hpp"

namespace {

using namespace muster;

struct Corridor {
  static constexpr auto id = "effect.corridor/1";
  static constexpr auto summary = "a corridor guides waves: levels in it fall more slowly";
  static constexpr auto manual =
      "Adds gain x 5 log10(1 + (d / width)^2) where both ends are in the strip of this width about the line from (x0, "
      "y0) to (x1, y1): nothing within a width, and beyond it a path-loss exponent that is lower by `gain`.";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {
      real("x0", 0, -1e6, 1e6, "m", "one end of its middle line, east").required().free().with(MUSTER_EAST),
      real("y0", 0, -1e6, 1e6, "m", "one end of its middle line, north").required().free().with(MUSTER_NORTH),
      real("x1", 0, -1e6, 1e6, "m", "the other end, east").required().free().with(MUSTER_EAST),
      real("y1", 0, -1e6, 1e6, "m", "the other end, north").required().free().with(MUSTER_NORTH),
      real("width", 2, 0.3, 30, "m", "from wall to wall").free().with(MUSTER_LOG),
      real("gain", 0, 0, 4, "", "by which the path-loss exponent is lower").free().with(MUSTER_LINEAR),
  };
  static constexpr muster_cause cause = {
      sizeof(muster_cause),
      MUSTER_TERM,
      "the corridor from ({x0}, {y0}) to ({x1}, {y1}) guides: its path-loss exponent is lower by {gain}",
      "",
      places_in_plan,
      "effect.dual_slope effect.two_ray effect.multiwall_saturation",
      "measure at equal distances inside the corridor and in an open room",
      nullptr,
      0,
  };

  explicit Corridor(Setup& s)
      : x0(s.value("x0")),
        y0(s.value("y0")),
        x1(s.value("x1")),
        y1(s.value("y1")),
        width(s.value("width")),
        gain(s.value("gain")),
        links(s) {}

  void step(const Step& k) const {
    const Rectangle inside = strip(k[x0], k[y0], k[x1], k[y1], k[width]);
    links.add_both_ways(k, [&](const End& a, const End& b) {
      if (!inside.holds(a.at) || !inside.holds(b.at)) return 0.0;
      const double ratio = distance(a, b) / k[width];
      return k[gain] * 5 * std::log10(1 + ratio * ratio);
    });
  }

  Value x0, y0, x1, y1, width, gain;
  LinkTerm links;
};

}  // namespace

MUSTER_PLUGIN_IS(Corridor)
