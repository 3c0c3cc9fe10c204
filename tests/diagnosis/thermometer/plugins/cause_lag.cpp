// A thermometer that follows the day curve late.
#include <cmath>

#include "samples.hpp"

namespace {

using namespace muster;

struct Lag {
  static constexpr auto id = "cause.lag/1", summary = "a thermometer follows the day late";
  static constexpr auto phase = MUSTER_SENSE;
  static constexpr Param params[] = {
      reference("thermometer", "thermometer", "of which").required(),
      real("delay", 3600, 600, 21600, "s", "of a first-order lag").free().with(MUSTER_LOG),
      real("swing", 0, 0, 30, "K", "of the day curve that it follows").free().with(MUSTER_LINEAR)};
  static constexpr muster_cause cause = {sizeof(muster_cause),
                                         MUSTER_TERM,
                                         "{thermometer} follows {delay} late",
                                         "thermometer",
                                         "t",
                                         "cause.offset",
                                         "move it into the air stream",
                                         nullptr,
                                         0};
  explicit Lag(Setup& s)
      : thermometer(s.value("thermometer")), delay(s.value("delay")), swing(s.value("swing")), term(s) {}
  // First-order lag of a sine: amplitude 1 / sqrt(1 + (w tau)^2), phase -atan(w tau).
  void step(const Step& k) const {
    const double w = 2 * 3.141592653589793 / 86400, late = std::atan(w * k[delay]), kept = std::cos(late);
    term.add(k, [&](double t, double which) {
      return which == k[thermometer] ? k[swing] * (kept * std::sin(w * t - late) - std::sin(w * t)) : 0;
    });
  }
  Value thermometer, delay, swing;
  SampleTerm term;
};

}  // namespace

MUSTER_PLUGIN_IS(Lag)
