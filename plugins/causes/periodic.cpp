// A level that swings: a machine, a lift, a duty cycle.
#include <cmath>
#include <muster/plugin.hpp>

#include "time_shapes.hpp"

namespace {

using namespace muster;

struct Periodic {
  static constexpr auto id = "effect.periodic/1";
  static constexpr auto summary = "levels swing with a period";
  static constexpr auto manual =
      "Adds amplitude x cos(2 pi t / period - phase). With `radio`, on all links of that radio, else on every link.";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {
      reference("radio", "radio", "whose links; without it, all"),
      real("period", 60, 0.1, 1e10, "s", "of one swing").free().with(MUSTER_LOG),
      real("amplitude", 0, 0, 40, "dB", "half from the lowest to the highest").free().with(MUSTER_LINEAR),
      real("phase", 0, -3.141592653589793, 3.141592653589793, "rad", "of the highest level at t = 0")
          .free()
          .with(MUSTER_CYCLIC),
  };
  static constexpr muster_cause cause = {
      sizeof(muster_cause),
      MUSTER_TERM,
      "levels of {radio} swing by {amplitude} with a period of {period}",
      "radio",
      "t",
      "effect.drift effect.step effect.people",
      "stand still for ten periods",
      nullptr,
      0,
  };

  explicit Periodic(Setup& s)
      : radio(s.value("radio")),
        period(s.value("period")),
        amplitude(s.value("amplitude")),
        crest(s.value("phase")),
        links(s) {}

  void step(const Step& k) const {
    links.add(k, [&](const End& from, const End& to) {
      return concerns(k[radio], from, to) ? swung(k[amplitude], k[period], k[crest], to.t) : 0.0;
    });
  }

  Value radio, period, amplitude, crest;
  LinkTerm links;
};

}  // namespace

MUSTER_PLUGIN_IS(Periodic)
