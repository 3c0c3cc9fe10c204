// Physics without physics: the wheels follow their commands exactly, except one that is stuck, and the body stays at
// its place.
#include <muster/plugin.hpp>

namespace {

using namespace muster;

struct TestTurner {
  static constexpr auto id = "test.turner/1";
  static constexpr auto summary = "wheels that do what they are asked";
  static constexpr auto phase = MUSTER_PHYSICS;
  static constexpr Param params[] = {choice("stuck", "none|left|right", "the wheel that does not turn")};

  explicit TestTurner(Setup& s)
      : stuck(s.value("stuck")),
        drive(s.read<Drive>("robot/*/drive")),
        wheels(s.write<Wheels>("robot/*/wheels")),
        pose(s.write<Pose>("robot/*/pose")),
        twist(s.write<Twist>("robot/*/twist")) {}

  void step(const Step& k) const {
    for (std::size_t i = 0; i < k[wheels].size(); ++i) {
      const Drive& d = k[drive][i];
      const Wheels& w = k.last(wheels)[i];
      const double left = k[stuck] == 1 ? 0 : d.left + d.left_rate * k.dt() / 2;
      const double right = k[stuck] == 2 ? 0 : d.right + d.right_rate * k.dt() / 2;
      k[wheels][i] = {w.left + left * k.dt(), w.right + right * k.dt(), left, right};
      k[pose][i] = k.last(pose)[i];
      k[twist][i] = {0, 0, 0, 0, 0, 0};
    }
  }

  Value stuck;
  In<Drive> drive;
  Out<Wheels> wheels;
  Out<Pose> pose;
  Out<Twist> twist;
};

}  // namespace

MUSTER_PLUGIN_IS(TestTurner)
