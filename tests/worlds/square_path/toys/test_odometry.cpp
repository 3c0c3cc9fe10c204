// Odometry of a Scarab whose owner is wrong about its wheels: the wheel base, and how the diameters compare.
#include <muster/plugin.hpp>

#include "plugins/robots/dead_reckoning.hpp"

namespace {

using namespace muster;

struct TestOdometry {
  static constexpr auto id = "test.odometry/1";
  static constexpr auto summary = "dead reckoning with wrong wheels";
  static constexpr auto phase = MUSTER_SENSE;
  static constexpr Param params[] = {
      real("base", 1, 0.5, 2, "", "the true wheel base over the believed one"),
      real("diameters", 1, 0.5, 2, "", "the true ratio of right to left diameter over the believed one")};

  explicit TestOdometry(Setup& s)
      : base(s.value("base")),
        diameters(s.value("diameters")),
        wheels(s.read<Wheels>("robot/*/wheels")),
        odometry(s.write<Odometry>("robot/*/odometry", MUSTER_SENSED)),
        seen(s.write<Wheels>("robot/*/wheels_seen")) {}

  // The mean of the believed diameters is the true one, so that a leg is as long as it should be.
  void step(const Step& k) const {
    constexpr double radius = 0.05, wheel_base = 0.21;
    const double larger = 2 * k[diameters] / (1 + k[diameters]), smaller = 2 / (1 + k[diameters]);
    for (std::size_t i = 0; i < k[odometry].size(); ++i) {
      const double left = larger * radius * (k[wheels][i].left - k.last(seen)[i].left);
      const double right = smaller * radius * (k[wheels][i].right - k.last(seen)[i].right);
      k[odometry][i] = k.last(odometry)[i];
      roll(k[odometry][i], (left + right) / 2, (right - left) / (wheel_base / k[base]));
      k[seen][i] = k[wheels][i];
    }
  }

  Value base, diameters;
  In<Wheels> wheels;
  Out<Odometry> odometry;
  Out<Wheels> seen;
};

}  // namespace

MUSTER_PLUGIN_IS(TestOdometry)
