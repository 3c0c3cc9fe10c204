// The drive of a robot on two wheels: commands become wheel rates, which its motors reach with a lag.
#include <cmath>
#include <muster/plugin.hpp>

namespace {

using namespace muster;

struct SkeletonDrive {
  static constexpr auto id = "robots.skeleton/1";
  static constexpr auto summary = "commands to wheel rates, with a lag of the motors";
  static constexpr auto phase = MUSTER_ACTUATE;
  static constexpr Param params[] = {real("wheel_radius", 0.08, 0.001, 10, "m", "radius of both wheels"),
                                     real("wheel_base", 0.36, 0.001, 10, "m", "way from wheel to wheel"),
                                     real("lag", 0.2, 0.001, 10, "s", "time constant of the motors").free()};

  explicit SkeletonDrive(Setup& s)
      : radius(s.value("wheel_radius")),
        base(s.value("wheel_base")),
        lag(s.value("lag")),
        command(s.read_if_any<Command>("robot/*/command")),
        drive(s.write<Drive>("robot/*/drive")) {}

  // A rate holds at the start of the step, its slope over the step.
  void step(const Step& k) const {
    const double share = 1 - std::exp(-k.dt() / k[lag]);
    for (std::size_t i = 0; i < k[drive].size(); ++i) {
      const Command asked = i < k[command].size() && k.alive("robot", i) ? k[command][i] : Command{0, 0};
      const double turn = asked.w * k[base] / 2;
      const Drive& before = k.last(drive)[i];  // all that is kept from step to step is in a table
      Drive& now = k[drive][i];
      now.left = before.left + before.left_rate * k.dt();
      now.right = before.right + before.right_rate * k.dt();
      now.left_rate = ((asked.v - turn) / k[radius] - now.left) * share / k.dt();
      now.right_rate = ((asked.v + turn) / k[radius] - now.right) * share / k.dt();
    }
  }

  Value radius, base, lag;
  In<Command> command;
  Out<Drive> drive;
};

}  // namespace

MUSTER_PLUGIN_IS(SkeletonDrive)
