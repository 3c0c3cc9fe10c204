// Directional gain of a stationary radio's antenna.
#include <cmath>
#include <muster/plugin.hpp>

#include "link_term.hpp"

namespace {

using namespace muster;

struct AntennaTx {
  static constexpr auto id = "effect.antenna_tx/1";
  static constexpr auto summary = "the antenna of a standing radio favours one side";
  static constexpr auto manual =
      "Adds amplitude x cos(bearing - direction) to every link of `radio`, the bearing being that of the other radio "
      "from its own heading. An antenna is reciprocal: the same counts where the radio receives. Of a radio that "
      "never turns only the direction in the world shows.";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {
      reference("radio", "radio", "whose antenna").required(),
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
      places_in_plan,
      "effect.tx_offset effect.unmapped_wall effect.obstacle effect.room_clutter",
      "turn the radio by half a turn and measure at the same places again",
      nullptr,
      0,
  };

  explicit AntennaTx(Setup& s)
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

MUSTER_PLUGIN_IS(AntennaTx)
