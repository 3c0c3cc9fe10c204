// A radio that is heard better than it hears, or worse.
#include <muster/plugin.hpp>

#include "link_term.hpp"

namespace {

using namespace muster;

struct Asymmetry {
  static constexpr auto id = "effect.asymmetry/1";
  static constexpr auto summary = "a radio is heard better than it hears: a -> b differs from b -> a";
  static constexpr auto manual =
      "Between what `radio` receives and what it sends there is a difference of `loss`: links that it receives lose "
      "(1 - sending) x loss, links that it sends gain sending x loss. Half and half, the mean of both ways stays what "
      "it was. A diagnosis holds `sending` at 0.5: of a deaf receiver (0) it tells the same `loss`, and leaves a mean "
      "that is lower by half of it to l0 or to another cause.";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {
      reference("radio", "radio", "which radio").required(),
      real("loss", 0, -60, 60, "dB", "by which it hears less than it is heard").free().with(MUSTER_LINEAR),
      real("sending", 0.5, 0, 1, "", "share of it that is a strong transmitter; the rest is a deaf receiver"),
  };
  static constexpr muster_cause cause = {
      sizeof(muster_cause),
      MUSTER_TERM,
      "the radio {radio} is heard {loss|better|worse} than it hears",
      "radio",
      "",
      "effect.tx_offset effect.rx_offset",
      "let both radios send and receive at the same places, then exchange the device",
      nullptr,
      MUSTER_BOTH_ENDS,
  };

  explicit Asymmetry(Setup& s)
      : radio(s.value("radio")), loss(s.value("loss")), sending(s.value("sending")), links(s) {}

  void step(const Step& k) const {
    links.add(k, [&](const End& from, const End& to) {
      return (from.radio == k[radio] ? k[sending] * k[loss] : 0) -
             (to.radio == k[radio] ? (1 - k[sending]) * k[loss] : 0);
    });
  }

  Value radio, loss, sending;
  LinkTerm links;
};

}  // namespace

MUSTER_PLUGIN_IS(Asymmetry)
