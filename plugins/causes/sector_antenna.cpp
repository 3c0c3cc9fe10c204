// A panel that covers a sector, where the world says an antenna alike to all sides.
#include <algorithm>
#include <cmath>
#include <muster/plugin.hpp>

#include "link_term.hpp"

namespace {

using namespace muster;

struct SectorAntenna {
  static constexpr auto id = "effect.sector_antenna/1";
  static constexpr auto summary = "a radio has a sector antenna";
  static constexpr auto manual =
      "Takes front_to_back x min((a / edge)^2, 1) from every link of `radio`, where a is the angle between `direction` "
      "and the bearing of the other radio from its own heading: the pattern of 3GPP TR 36.814 (table A.2.1.1-2), whose "
      "beam is 2 edge sqrt(3 dB / front_to_back) wide where it is 3 dB down. An antenna is reciprocal: the same counts "
      "where the radio receives. Of a radio that never turns only the direction in the world shows.";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {
      reference("radio", "radio", "whose antenna").required(),
      real("front_to_back", 0, 0, 50, "dB", "gain in the middle of the sector over that behind")
          .free()
          .with(MUSTER_LINEAR),
      real("direction", 0, -3.141592653589793, 3.141592653589793, "rad",
           "of the sector's middle, from the radio's heading to its left")
          .free()
          .with(MUSTER_CYCLIC),
      real("edge", 1.6, 0.5, 2.8, "rad", "from the middle to where nothing more is lost").free().with(MUSTER_LOG),
  };
  static constexpr muster_cause cause = {
      sizeof(muster_cause),
      MUSTER_TERM,
      "the antenna of {radio} covers a sector about {direction}, with {front_to_back} less from {edge} off it",
      "radio",
      places_in_plan,
      "effect.antenna_tx effect.antenna_rx effect.body_shadow effect.tx_offset effect.unmapped_wall",
      "turn the radio by half a turn and measure at the same places again",
      nullptr,
      0,
  };

  explicit SectorAntenna(Setup& s)
      : radio(s.value("radio")),
        front_to_back(s.value("front_to_back")),
        direction(s.value("direction")),
        edge(s.value("edge")),
        links(s) {}

  void step(const Step& k) const {
    links.add(k, [&](const End& from, const End& to) {
      return at_radio(k[radio], from, to, [&](const End& own, const End& other) {
        const double off = std::remainder(bearing(own, other) - k[direction], full_turn) / k[edge];
        return -k[front_to_back] * std::min(off * off, 1.0);
      });
    });
  }

  Value radio, front_to_back, direction, edge;
  LinkTerm links;
};

}  // namespace

MUSTER_PLUGIN_IS(SectorAntenna)
