// A heater that was switched: all samples jump at some time.
#include "samples.hpp"

namespace {

using namespace muster;

struct Jump {
  static constexpr auto id = "cause.step/1", summary = "the room's temperature jumps";
  static constexpr auto phase = MUSTER_SENSE;
  static constexpr Param params[] = {real("at", 0, 0, 1e9, "s", "time of the jump").free(),
                                     real("size", 0, -20, 20, "K", "of the jump").free().with(MUSTER_LINEAR)};
  static constexpr muster_cause cause = {sizeof(muster_cause),
                                         MUSTER_TERM,
                                         "at {at} the room jumps by {size}",
                                         "",
                                         "t",
                                         "cause.offset",
                                         "look into the heater's log",
                                         nullptr,
                                         0};
  explicit Jump(Setup& s) : at(s.value("at")), size(s.value("size")), term(s) {}
  void step(const Step& k) const {
    term.add(k, [&](double t, double) { return t >= k[at] ? k[size] : 0; });
  }
  Value at, size;
  SampleTerm term;
};

}  // namespace

MUSTER_PLUGIN_IS(Jump)
