// A course in time of one sender: in a network that hears both ways it is told from one of all its links.
#include <algorithm>
#include <cmath>
#include <muster/plugin.hpp>

#include "time_shapes.hpp"

namespace {

using namespace muster;

struct TxDrift {
  static constexpr auto id = "effect.tx_drift/2";
  static constexpr auto summary = "what a radio sends drifts with time, steadily or until it settles";
  static constexpr auto manual =
      "Adds rate x s (1 - exp(-u / s)), u being the time since `start` (0 before it) and s = settling: steady for "
      "much longer than the data last, else a warm-up. On what `radio` sends alone: a supply or an amplifier that "
      "changes. Of a radio that only sends it is a drift: the readings are the same. "
      "A diagnosis seeks `start` from the first reading on. On a clock since 1970 a world has to write it: by default "
      "the drift began in 1970.";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {
      reference("radio", "radio", "which radio").required(),
      real("rate", 0, -1e5, 1e5, "dB/h", "slope at the start").free().with(MUSTER_LINEAR),
      real("settling", 1e6, 1, 1e10, "s", "time in which the slope falls to 1/e").free().with(MUSTER_LOG),
      real("start", 0, -1e10, 1e10, "s", "when it begins, by the clock of the run, or of the column t of data").free(),
  };
  static constexpr muster_cause cause = {
      sizeof(muster_cause),
      MUSTER_TERM,
      "from {start} on what {radio} sends drifts by {rate}, settling in {settling}",
      "radio",
      "t",
      "effect.drift effect.tx_offset effect.tx_step",
      "measure once more in the order of before: a sender drifts on all its links, and what it hears does not",
      nullptr,
      MUSTER_BOTH_ENDS,
  };

  explicit TxDrift(Setup& s)
      : radio(s.value("radio")),
        rate(s.value("rate")),
        settling(s.value("settling")),
        start(s.value("start")),
        links(s) {}

  void step(const Step& k) const {
    links.add(k, [&](const End& from, const End& to) {
      return from.radio == k[radio] ? drifted(k[rate], k[settling], k[start], to.t) : 0.0;
    });
  }

  Value radio, rate, settling, start;
  LinkTerm links;
};

}  // namespace

MUSTER_PLUGIN_IS(TxDrift)
