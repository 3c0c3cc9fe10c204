// A thermometer that reads high or low.
#include "samples.hpp"

namespace {

using namespace muster;

struct Offset {
  static constexpr auto id = "cause.offset/1", summary = "a thermometer reads high or low";
  static constexpr auto phase = MUSTER_SENSE;
  static constexpr Param params[] = {reference("thermometer", "thermometer", "of which").required(),
                                     real("offset", 0, -20, 20, "K", "too high").free().with(MUSTER_LINEAR)};
  static constexpr muster_cause cause = {sizeof(muster_cause),
                                         MUSTER_TERM,
                                         "{thermometer} reads {offset|too high|too low}",
                                         "thermometer",
                                         "",
                                         "cause.step",
                                         "put two thermometers side by side",
                                         nullptr,
                                         0};
  explicit Offset(Setup& s) : thermometer(s.value("thermometer")), offset(s.value("offset")), term(s) {}
  void step(const Step& k) const {
    term.add(k, [&](double, double which) { return which == k[thermometer] ? k[offset] : 0; });
  }
  Value thermometer, offset;
  SampleTerm term;
};

}  // namespace

MUSTER_PLUGIN_IS(Offset)
