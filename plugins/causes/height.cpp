// A floor or ceiling missing from the map.
#include <muster/plugin.hpp>

#include "link_term.hpp"

namespace {

using namespace muster;

struct Height {
  static constexpr auto id = "effect.height/1";
  static constexpr auto summary = "a floor between two radios costs";
  static constexpr auto manual =
      "Takes away `loss` of every link with one end below the height z and the other at it or above. All z between "
      "the highest radio below and the lowest above do the same.";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {
      real("z", 2.7, -1e4, 1e4, "m", "height of the floor").free(),
      real("loss", 0, 0, 60, "dB", "of a link through it").free().with(MUSTER_LINEAR),
  };
  static constexpr muster_cause cause = {
      sizeof(muster_cause),
      MUSTER_TERM,
      "a floor at the height {z} costs {loss}",
      "",
      "tx_z rx_z",
      "effect.tx_offset effect.two_ray effect.antenna_tx",
      "lower the radio through the height, at the same place in plan",
      nullptr,
      0,
  };

  explicit Height(Setup& s) : z(s.value("z")), loss(s.value("loss")), links(s) {}

  void step(const Step& k) const {
    links.add(k, [&](const End& a, const End& b) { return (a.at.z < k[z]) != (b.at.z < k[z]) ? -k[loss] : 0; });
  }

  Value z, loss;
  LinkTerm links;
};

}  // namespace

MUSTER_PLUGIN_IS(Height)
