// A level that changes slowly: something warms up, a battery empties.
#include <algorithm>
#include <cmath>
#include <muster/plugin.hpp>

#include "time_shapes.hpp"

namespace {

using namespace muster;

struct Drift {
  static constexpr auto id = "effect.drift/2";
  static constexpr auto summary = "levels drift with time, steadily or until they settle";
  static constexpr auto manual =
      "Adds rate x s (1 - exp(-u / s)), u being the time since `start` (0 before it) and s = settling: steady for "
      "much longer than the data last, else a warm-up. With `radio`, on all links of that radio, else on every link. "
      "A diagnosis seeks `start` from the first reading on. On a clock since 1970 a world has to write it: by default "
      "the drift began in 1970.";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {
      reference("radio", "radio", "whose links; without it, all"),
      real("rate", 0, -1e5, 1e5, "dB/h", "slope at the start").free().with(MUSTER_LINEAR),
      real("settling", 1e6, 1, 1e10, "s", "time in which the slope falls to 1/e").free().with(MUSTER_LOG),
      real("start", 0, -1e10, 1e10, "s", "when it begins, by the clock of the run, or of the column t of data").free(),
  };
  static constexpr muster_cause cause = {
      sizeof(muster_cause),
      MUSTER_TERM,
      "from {start} on levels of {radio} drift by {rate}, settling in {settling}",
      "radio",
      "t",
      "effect.step effect.periodic effect.rx_offset effect.room_clutter",
      "come back to the places of the beginning at the end",
      nullptr,
      0,
  };

  explicit Drift(Setup& s)
      : radio(s.value("radio")),
        rate(s.value("rate")),
        settling(s.value("settling")),
        start(s.value("start")),
        links(s) {}

  void step(const Step& k) const {
    links.add(k, [&](const End& from, const End& to) {
      return concerns(k[radio], from, to) ? drifted(k[rate], k[settling], k[start], to.t) : 0.0;
    });
  }

  Value radio, rate, settling, start;
  LinkTerm links;
};

}  // namespace

MUSTER_PLUGIN_IS(Drift)
