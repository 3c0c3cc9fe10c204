// A level that jumped: an antenna was touched, a setting changed.
#include <muster/plugin.hpp>

#include "time_shapes.hpp"

namespace {

using namespace muster;

struct Jump {
  static constexpr auto id = "effect.step/1";
  static constexpr auto summary = "levels jump at some time";
  static constexpr auto manual =
      "Adds `size` from the time `at` on. With `radio`, on all links of that radio, else on every link.";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {
      reference("radio", "radio", "whose links; without it, all"),
      real("at", 0, -1e10, 1e10, "s", "when, by the clock of the run, or of the column t of data").free(),
      real("size", 0, -60, 60, "dB", "of the jump").free().with(MUSTER_LINEAR),
  };
  static constexpr muster_cause cause = {
      sizeof(muster_cause),
      MUSTER_TERM,
      "at {at} levels of {radio} jump by {size}",
      "radio",
      "t",
      "effect.drift effect.rx_offset effect.room_clutter effect.periodic",
      "come back to the places of the beginning at the end; look into the log for what was changed",
      nullptr,
      0,
  };

  explicit Jump(Setup& s) : radio(s.value("radio")), at(s.value("at")), size(s.value("size")), links(s) {}

  void step(const Step& k) const {
    links.add(k, [&](const End& from, const End& to) {
      return concerns(k[radio], from, to) ? jumped(k[at], k[size], to.t) : 0.0;
    });
  }

  Value radio, at, size;
  LinkTerm links;
};

}  // namespace

MUSTER_PLUGIN_IS(Jump)
