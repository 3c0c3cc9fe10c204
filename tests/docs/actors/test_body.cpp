// The least physics that follows a command: a unicycle on flat ground.
#include <cmath>
#include <muster/plugin.hpp>

namespace {

using namespace muster;

struct Body {
  static constexpr auto id = "test.body/1", summary = "a unicycle";
  static constexpr auto phase = MUSTER_PHYSICS;

  explicit Body(Setup& s) : command(s.read<Command>("robot/*/command")), pose(s.write<Pose>("robot/*/pose")) {}

  void step(const Step& k) const {
    for (std::size_t i = 0; i < k[pose].size(); ++i) {
      const Pose& was = k.last(pose)[i];
      const double yaw = 2 * std::atan2(was.qz, was.qw), ahead = k[command][i].v * k.dt();
      const double turned = yaw + k[command][i].w * k.dt();
      k[pose][i] = {was.x + ahead * std::cos(yaw), was.y + ahead * std::sin(yaw), was.z, std::cos(turned / 2), 0, 0,
                    std::sin(turned / 2)};
    }
  }

  In<Command> command;
  Out<Pose> pose;
};

}  // namespace

MUSTER_PLUGIN_IS(Body)
