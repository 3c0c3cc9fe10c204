// Drives to a goal pose from another controller: Player's position commands.
#include <muster/plugin.hpp>

#include "plugins/heading.hpp"

namespace {

using namespace muster;

struct ControlGoal2d {
  static constexpr auto id = "control.goal2d/1";
  static constexpr auto summary = "drives a robot to where goal2d asks it to be, by its own odometry";
  static constexpr auto manual =
      "The robot turns towards the place in proportion to the bearing and drives with its cosine, at `speed` or, near\n"
      "it, at `slow_gain` for each metre; it turns on the spot while the place lies behind. Within `tolerance` it\n"
      "stops and turns to the heading asked for, if there is one; it sets out again where it finds itself beyond\n"
      "twice that. instance/NAME/arrived is 1 while it stands as it was asked, heading within `turn_tolerance`.";
  static constexpr auto phase = MUSTER_CONTROL;
  static constexpr Param params[] = {
      reference("robot", "robot", "the robot it steers").required(),
      real("speed", 0.3, 0, 10, "m/s", "forward speed"),
      real("slow_gain", 1, 0, 100, "1/s", "forward speed for each metre of distance"),
      real("turn_gain", 2, 0, 100, "1/s", "turn rate for each radian of bearing"),
      real("turn_speed", 1, 0, 10, "rad/s", "largest turn rate"),
      real("tolerance", 0.01, 1e-6, 10, "m", "the place is reached within this distance"),
      real("turn_tolerance", 0.01, 1e-6, 3, "rad", "and the heading within this angle")};

  struct Arrived {
    static constexpr const char* columns = "there arrived x[m]? y[m]?";
    double there, arrived;  // 0 or 1: at the place; at the place with the wanted heading
    double x, y;            // of the place that it is at
  };

  explicit ControlGoal2d(Setup& s)
      : speed(s.value("speed")),
        slow_gain(s.value("slow_gain")),
        turn_gain(s.value("turn_gain")),
        turn_speed(s.value("turn_speed")),
        tolerance(s.value("tolerance")),
        turn_tolerance(s.value("turn_tolerance")),
        goal(s.read<Goal2d>("robot/{robot}/goal2d")),
        odometry(s.read<Odometry>("robot/{robot}/odometry")),
        command(s.write<Command>("robot/{robot}/command")),
        arrived(s.write<Arrived>("self/arrived")) {}

  void step(const Step& k) const {
    const Goal2d& to = *k[goal];
    const Odometry& here = *k[odometry];
    *k[command] = {0, 0};
    *k[arrived] = {0, 0, null(), null()};
    if (is_null(to.x) || is_null(to.y)) return;
    const Turning turning{k[turn_gain], k[turn_speed]};
    const double away = std::hypot(to.x - here.x, to.y - here.y);
    const Arrived& before = *k.last(arrived);
    const bool was_there = before.there != 0 && before.x == to.x && before.y == to.y;
    const bool there = away <= k[tolerance] * (was_there ? 2 : 1);
    if (!there) {
      *k[command] = towards(here, to.x, to.y, std::min(k[speed], k[slow_gain] * away), turning);
      return;
    }
    const double off = is_null(to.yaw) ? 0 : turn_to(to.yaw, here.yaw);
    k[command]->w = turning.rate(off);
    *k[arrived] = {1, std::abs(off) <= k[turn_tolerance] ? 1.0 : 0.0, to.x, to.y};
  }

  Value speed, slow_gain, turn_gain, turn_speed, tolerance, turn_tolerance;
  In<Goal2d> goal;
  In<Odometry> odometry;
  Out<Command> command;
  Out<Arrived> arrived;
};

}  // namespace

MUSTER_PLUGIN_IS(ControlGoal2d)
