// A room's temperature: a mean, a trend and a day curve.
#include <cmath>

#include "samples.hpp"

namespace {

using namespace muster;

struct Room {
  static constexpr auto id = "room.temperature/1", summary = "mean, trend and day curve of a room";
  static constexpr auto phase = MUSTER_SENSE;
  static constexpr Param params[] = {real("mean", 293, 200, 400, "K", "at time 0").free(),
                                     real("trend", 0, -1e-3, 1e-3, "K/s", "of the mean").free(),
                                     real("swing", 3, 0, 30, "K", "half the range of a day").free()};
  explicit Room(Setup& s) : mean(s.value("mean")), trend(s.value("trend")), swing(s.value("swing")), term(s) {}
  void step(const Step& k) const {
    term.add(k, [&](double t, double) {
      return k[mean] + k[trend] * t + k[swing] * std::sin(2 * 3.141592653589793 * t / 86400);
    });
  }
  Value mean, trend, swing;
  SampleTerm term;
};

}  // namespace

MUSTER_PLUGIN_IS(Room)
