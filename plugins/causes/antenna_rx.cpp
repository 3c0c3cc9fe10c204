// Directional gain of a moving radio's antenna.
#include <cmath>
#include <muster/plugin.hpp>

#include "link_term.hpp"

namespace {

using namespace muster;

struct AntennaRx {
  static constexpr auto id = "effect.antenna_rx/1";
  static constexpr auto summary = "the antenna of a moving radio favours one side";
  static constexpr auto manual =
      "Adds amplitude x cos(bearing - direction), the bearing being that of the other radio from its own heading. "
      "With `radio`, on all links of that radio, in either direction alike. Without, at the receiving end of every "
      "link: for "
      "data in which all that listen carry the same antenna.";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {
      reference("radio", "radio", "whose antenna; without it, that of every receiver"),
      real("amplitude", 0, 0, 40, "dB", "gain in that direction over the mean of all").free().with(MUSTER_LINEAR),
      real("direction", 0, -3.141592653589793, 3.141592653589793, "rad",
           "of highest gain, from the radio's heading to its left")
          .free()
          .with(MUSTER_CYCLIC),
  };
  static constexpr muster_cause cause = {
      sizeof(muster_cause),
      MUSTER_TERM,
      "the antenna of {radio} favours {direction} by {amplitude}",
      "radio",
      "tx_x tx_y rx_x rx_y rx_yaw",
      "effect.body_shadow effect.rx_offset",
      "turn on the spot once: a shadow is a narrow dip, an antenna a wave over the whole turn",
      nullptr,
      0,
  };

  explicit AntennaRx(Setup& s)
      : radio(s.value("radio")), amplitude(s.value("amplitude")), direction(s.value("direction")), links(s) {}

  void step(const Step& k) const {
    links.add(k, [&](const End& from, const End& to) {
      return at_radio(k[radio], from, to, [&](const End& own, const End& other) {
        return k[amplitude] * std::cos(bearing(own, other) - k[direction]);
      });
    });
  }

  Value radio, amplitude, direction;
  LinkTerm links;
};

}  // namespace

MUSTER_PLUGIN_IS(AntennaRx)
