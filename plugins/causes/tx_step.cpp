// A course in time of one sender: in a network that hears both ways it is told from one of all its links.
#include <muster/plugin.hpp>

#include "time_shapes.hpp"

namespace {

using namespace muster;

struct TxStep {
  static constexpr auto id = "effect.tx_step/1";
  static constexpr auto summary = "what a radio sends jumps at some time";
  static constexpr auto manual =
      "Adds `size` from the time `at` on. On what `radio` sends alone: a supply or an amplifier that changes. Of a "
      "radio that only sends it is a step: the readings are the same.";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {
      reference("radio", "radio", "which radio").required(),
      real("at", 0, -1e10, 1e10, "s", "when, by the clock of the run, or of the column t of data").free(),
      real("size", 0, -60, 60, "dB", "of the jump").free().with(MUSTER_LINEAR),
  };
  static constexpr muster_cause cause = {
      sizeof(muster_cause),
      MUSTER_TERM,
      "at {at} what {radio} sends jumps by {size}",
      "radio",
      "t",
      "effect.step effect.tx_drift effect.tx_offset",
      "look into the log of that radio for what was changed",
      nullptr,
      MUSTER_BOTH_ENDS,
  };

  explicit TxStep(Setup& s) : radio(s.value("radio")), at(s.value("at")), size(s.value("size")), links(s) {}

  void step(const Step& k) const {
    links.add(
        k, [&](const End& from, const End& to) { return from.radio == k[radio] ? jumped(k[at], k[size], to.t) : 0.0; });
  }

  Value radio, at, size;
  LinkTerm links;
};

}  // namespace

MUSTER_PLUGIN_IS(TxStep)
