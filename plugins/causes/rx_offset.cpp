// A constant offset of a receiver's readings.
#include <muster/plugin.hpp>

#include "link_term.hpp"

namespace {

using namespace muster;

struct RxOffset {
  static constexpr auto id = "effect.rx_offset/1";
  static constexpr auto summary = "a radio reads every level too high or too low";
  static constexpr auto manual =
      "Adds `offset` to every link that `radio` receives. Of a radio that only receives, a wrong scale, a deaf "
      "receiver and a lossy feeder are the same shift: each is told as this one.";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {
      reference("radio", "radio", "which radio").required(),
      real("offset", 0, -60, 60, "dB", "what it reads above the truth").free().with(MUSTER_LINEAR),
  };
  static constexpr muster_cause cause = {
      sizeof(muster_cause),
      MUSTER_TERM,
      "the radio {radio} reads {offset|too high|too low}",
      "radio",
      "",
      "effect.antenna_rx effect.asymmetry effect.drift effect.step",
      "let a second receiver stand where this one stood, or exchange the two",
      nullptr,
      0,
  };

  explicit RxOffset(Setup& s) : radio(s.value("radio")), offset(s.value("offset")), links(s) {}

  void step(const Step& k) const {
    links.add(k, [&](const End&, const End& to) { return to.radio == k[radio] ? k[offset] : 0; });
  }

  Value radio, offset;
  LinkTerm links;
};

}  // namespace

MUSTER_PLUGIN_IS(RxOffset)
