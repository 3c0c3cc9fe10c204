// Dual-slope path loss: another exponent beyond a breakpoint.
#include <algorithm>
#include <cmath>
#include <muster/plugin.hpp>

#include "link_term.hpp"

namespace {

using namespace muster;

struct DualSlope {
  static constexpr auto id = "effect.dual_slope/1";
  static constexpr auto summary = "beyond a breakpoint the path-loss exponent is another";
  static constexpr auto manual =
      "Takes away 10 n_change log10(d / break) of links longer than `break`. Feuerstein and others, Path loss, delay "
      "spread and outage models as functions of antenna height, IEEE Trans. Vehicular Techn. 43 (1994).";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {
      real("break", 5, 0.5, 1e5, "m", "distance at which the slope changes").free().with(MUSTER_LOG),
      real("n_change", 0, -5, 10, "", "what the path-loss exponent is higher beyond it").free().with(MUSTER_LINEAR),
  };
  static constexpr muster_cause cause = {
      sizeof(muster_cause),
      MUSTER_TERM,
      "beyond {break} the path-loss exponent is {n_change|higher|lower}",
      "",
      "",
      "effect.corridor effect.two_ray effect.multiwall_saturation effect.incidence effect.rssi_floor",
      "measure in the open, without walls, from half to ten times the breakpoint",
      nullptr,
      0,
  };

  explicit DualSlope(Setup& s) : break_at(s.value("break")), n_change(s.value("n_change")), links(s) {}

  void step(const Step& k) const {
    links.add_both_ways(k, [&](const End& a, const End& b) {
      return -10 * k[n_change] * std::log10(std::max(distance(a, b) / k[break_at], 1.0));
    });
  }

  Value break_at, n_change;
  LinkTerm links;
};

}  // namespace

MUSTER_PLUGIN_IS(DualSlope)
