// Drives a robot some way from where its odometry began, and stops.
#include <algorithm>
#include <cmath>
#include <muster/plugin.hpp>

namespace {

using namespace muster;

struct SkeletonController {
  static constexpr auto id = "control.skeleton/1";
  static constexpr auto summary = "drives a robot some way ahead, and stops";
  static constexpr auto phase = MUSTER_CONTROL;
  static constexpr Param params[] = {reference("robot", "robot", "the robot it drives").required(),
                                     real("way", 1, 0, 1000, "m", "how far from the origin of its odometry"),
                                     real("speed", 0.3, 0, 10, "m/s", "most of its forward speed")};

  // A controller may read and write what belongs to its robot, and nothing else.
  explicit SkeletonController(Setup& s)
      : way(s.value("way")),
        speed(s.value("speed")),
        odometry(s.read<Odometry>("robot/{robot}/odometry")),
        command(s.write<Command>("robot/{robot}/command")) {}

  void step(const Step& k) const {
    const double left = k[way] - std::hypot(k[odometry]->x, k[odometry]->y);
    *k[command] = {std::clamp(left / slowing_time, 0.0, k[speed]), 0};
  }

  static constexpr double slowing_time = 1;  // s
  Value way, speed;
  In<Odometry> odometry;
  Out<Command> command;
};

}  // namespace

MUSTER_PLUGIN_IS(SkeletonController)
