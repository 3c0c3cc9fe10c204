// Robots that tumble about the world's origin like parts of one rigid body; with `apart`, robot 0 turns on the spot
// while the others are at rest.
#include <cmath>
#include <muster/plugin.hpp>

#include "plugins/radio_links/mount.hpp"

namespace {

using namespace muster;

struct Tumbler {
  static constexpr auto id = "test.tumbler/1", summary = "robots that tumble";
  static constexpr auto phase = MUSTER_PHYSICS;
  static constexpr Param params[] = {flag("apart", false, "robot 0 turns alone")};

  explicit Tumbler(Setup& s) : apart(s.value("apart")), pose(s.write<Pose>("robot/*/pose")) {}

  void step(const Step& k) const {
    const auto tick = static_cast<double>(k.tick());
    const Pose turn = turned(turned(about(0, 0.31 * tick), about(1, 0.17 * tick)), about(2, 0.23 * tick));
    for (std::size_t i = 0; i < k[pose].size(); ++i) {
      const auto row = static_cast<double>(i);
      const Pose own = turned(about(2, row), about(0, 0.4 * row)), still{0, 0, 0, 1, 0, 0, 0};
      const bool turns = k[apart] == 0 || i == 0;
      k[pose][i] = antenna_in_world({null(), 3 * row, row * row, 0.5 * row, 0}, turns ? turn : still);
      const Pose attitude = turned(turns ? turn : still, own);
      k[pose][i].qw = attitude.qw, k[pose][i].qx = attitude.qx, k[pose][i].qy = attitude.qy,
      k[pose][i].qz = attitude.qz;
    }
  }

  static Pose about(int axis, double angle) {
    const double s = std::sin(angle / 2);
    return {0, 0, 0, std::cos(angle / 2), axis == 0 ? s : 0, axis == 1 ? s : 0, axis == 2 ? s : 0};
  }

  Value apart;
  Out<Pose> pose;
};

}  // namespace

MUSTER_PLUGIN_IS(Tumbler)
