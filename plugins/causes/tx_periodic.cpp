// A course in time of one sender: in a network that hears both ways it is told from one of all its links.
#include <cmath>
#include <muster/plugin.hpp>

#include "time_shapes.hpp"

namespace {

using namespace muster;

struct TxPeriodic {
  static constexpr auto id = "effect.tx_periodic/1";
  static constexpr auto summary = "what a radio sends swings with a period";
  static constexpr auto manual =
      "Adds amplitude x cos(2 pi t / period - phase). On what `radio` sends alone: a supply or an amplifier that "
      "changes. Of a radio that only sends it is a periodic: the readings are the same.";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {
      reference("radio", "radio", "which radio").required(),
      real("period", 60, 0.1, 1e10, "s", "of one swing").free().with(MUSTER_LOG),
      real("amplitude", 0, 0, 40, "dB", "half from the lowest to the highest").free().with(MUSTER_LINEAR),
      real("phase", 0, -3.141592653589793, 3.141592653589793, "rad", "of the highest level at t = 0")
          .free()
          .with(MUSTER_CYCLIC),
  };
  static constexpr muster_cause cause = {
      sizeof(muster_cause),
      MUSTER_TERM,
      "what {radio} sends swings by {amplitude} with a period of {period}",
      "radio",
      "t",
      "effect.periodic effect.tx_drift",
      "log its supply and its temperature for ten periods",
      nullptr,
      MUSTER_BOTH_ENDS,
  };

  explicit TxPeriodic(Setup& s)
      : radio(s.value("radio")),
        period(s.value("period")),
        amplitude(s.value("amplitude")),
        crest(s.value("phase")),
        links(s) {}

  void step(const Step& k) const {
    links.add(k, [&](const End& from, const End& to) {
      return from.radio == k[radio] ? swung(k[amplitude], k[period], k[crest], to.t) : 0.0;
    });
  }

  Value radio, period, amplitude, crest;
  LinkTerm links;
};

}  // namespace

MUSTER_PLUGIN_IS(TxPeriodic)
