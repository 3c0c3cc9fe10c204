// A constant offset of a radio's transmit power.
#include <muster/plugin.hpp>

#include "link_term.hpp"

namespace {

using namespace muster;

struct TxOffset {
  static constexpr auto id = "effect.tx_offset/1";
  static constexpr auto summary = "a radio sends more or less than the world says";
  static constexpr auto manual = "Adds `offset` to every link that `radio` sends.";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {
      reference("radio", "radio", "which radio").required(),
      real("offset", 0, -60, 60, "dB", "what it sends more than the world says").free().with(MUSTER_LINEAR),
  };
  static constexpr muster_cause cause = {
      sizeof(muster_cause),
      MUSTER_TERM,
      "the radio {radio} sends {offset|more|less} than the world says",
      "radio",
      "",
      "effect.antenna_tx effect.room_clutter effect.asymmetry effect.obstacle effect.unmapped_wall",
      "drive once around the radio: its power is the same on all sides",
      nullptr,
      0,
  };

  explicit TxOffset(Setup& s) : radio(s.value("radio")), offset(s.value("offset")), links(s) {}

  void step(const Step& k) const {
    links.add(k, [&](const End& from, const End&) { return from.radio == k[radio] ? k[offset] : 0; });
  }

  Value radio, offset;
  LinkTerm links;
};

}  // namespace

MUSTER_PLUGIN_IS(TxOffset)
