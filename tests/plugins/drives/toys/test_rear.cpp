// Physics without physics: front wheels follow their commands, rear ones stand, and the body stays at its place.
#include <muster/plugin.hpp>

namespace {

using namespace muster;

struct TestRear {
  static constexpr auto id = "test.rear/1";
  static constexpr auto summary = "rear wheels that are held";
  static constexpr auto phase = MUSTER_PHYSICS;

  explicit TestRear(Setup& s)
      : drive(s.read<Drive>("robot/*/drive")),
        wheels(s.write<Wheels>("robot/*/wheels")),
        rear(s.write<Wheels>("robot/*/rear_wheels")),
        pose(s.write<Pose>("robot/*/pose")),
        twist(s.write<Twist>("robot/*/twist")) {}

  void step(const Step& k) const {
    for (std::size_t i = 0; i < k[wheels].size(); ++i) {
      const Drive& d = k[drive][i];
      const Wheels& w = k.last(wheels)[i];
      const double left = d.left + d.left_rate * k.dt() / 2, right = d.right + d.right_rate * k.dt() / 2;
      k[wheels][i] = {w.left + left * k.dt(), w.right + right * k.dt(), left, right};
      k[rear][i] = {0, 0, 0, 0};
      k[pose][i] = k.last(pose)[i];
      k[twist][i] = {0, 0, 0, 0, 0, 0};
    }
  }

  In<Drive> drive;
  Out<Wheels> wheels, rear;
  Out<Pose> pose;
  Out<Twist> twist;
};

}  // namespace

MUSTER_PLUGIN_IS(TestRear)
