// Shadow of a radio's own carrier on one side of it.
#include <cmath>
#include <muster/plugin.hpp>

#include "link_term.hpp"

namespace {

using namespace muster;

struct BodyShadow {
  static constexpr auto id = "effect.body_shadow/1";
  static constexpr auto summary = "the body that carries a radio shades a sector around it";
  static constexpr auto manual =
      "Takes away loss x exp(-ln 2 (2 a / width)^4), where a is the angle between `direction` and the bearing of the "
      "other radio from its own heading: flat behind the body, half of it where the sector ends. With `radio`, on all "
      "links of that radio, in either direction alike. Without, at the receiving end of every link.";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {
      reference("radio", "radio", "whose body; without it, that of every receiver"),
      real("loss", 0, 0, 40, "dB", "in the middle of the shadow").free().with(MUSTER_LINEAR),
      real("direction", 3.141592653589793, -3.141592653589793, 3.141592653589793, "rad",
           "of its middle, from the radio's heading to its left")
          .free()
          .with(MUSTER_CYCLIC),
      real("width", 1, 0.2, 2.2, "rad",
           "of the sector in which at least half is lost; a wider one is an antenna's pattern")
          .free()
          .with(MUSTER_LOG),
  };
  static constexpr muster_cause cause = {
      sizeof(muster_cause),
      MUSTER_TERM,
      "the body of {radio} takes {loss} in a sector {width} wide about {direction}",
      "radio",
      "tx_x tx_y rx_x rx_y rx_yaw",
      "effect.antenna_rx",
      "turn on the spot once: a shadow is a narrow dip, an antenna a wave over the whole turn",
      nullptr,
      0,
  };

  explicit BodyShadow(Setup& s)
      : radio(s.value("radio")),
        loss(s.value("loss")),
        direction(s.value("direction")),
        width(s.value("width")),
        links(s) {}

  void step(const Step& k) const {
    links.add(k, [&](const End& from, const End& to) {
      return at_radio(k[radio], from, to, [&](const End& own, const End& other) {
        const double away = std::remainder(bearing(own, other) - k[direction], full_turn);
        return -k[loss] * std::exp2(-std::pow(2 * away / k[width], 4));
      });
    });
  }

  Value radio, loss, direction, width;
  LinkTerm links;
};

}  // namespace

MUSTER_PLUGIN_IS(BodyShadow)
