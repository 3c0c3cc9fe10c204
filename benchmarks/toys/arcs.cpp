// Asks the wheels for the arcs, linear over each tick.
#include "arcs.hpp"

#include <muster/plugin.hpp>

namespace {

using namespace muster;

struct Arcs {
  static constexpr auto id = "bench.arcs/1", summary = "asks wheels for arcs";
  static constexpr auto phase = MUSTER_ACTUATE;

  explicit Arcs(Setup& s) : drive(s.write<Drive>("robot/*/drive")) {}

  void step(const Step& k) const {
    const double end = static_cast<double>(k.tick()) * k.dt(), begin = static_cast<double>(k.tick() - 1) * k.dt();
    int robot = 0;
    for (Drive& d : k[drive]) {
      const bench::Arc arc = bench::arc(robot++);
      const auto left = bench::rated(arc.left(begin), arc.left(end), k.dt());
      const auto right = bench::rated(arc.right(begin), arc.right(end), k.dt());
      d = {left.rate, right.rate, left.slope, right.slope};
    }
  }

  Out<Drive> drive;
};

}  // namespace

MUSTER_PLUGIN_IS(Arcs)
