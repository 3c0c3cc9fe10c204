// Drives through way points without turning: for robots that go sideways as they go ahead.
#include <algorithm>
#include <cmath>
#include <muster/ground_drives.hpp>
#include <muster/plugin.hpp>
#include <string>
#include <vector>

#include "plugins/heading.hpp"
#include "roadmap.hpp"
#include "robot_model.hpp"

namespace {

using namespace muster;

struct ControlStrafe {
  static constexpr auto id = "control.strafe/2";
  static constexpr auto summary = "drives a mecanum robot through way points, ahead and sideways, by its own odometry";
  static constexpr auto manual =
      "The robot goes straight to the next way point at `speed` or, near it, at `slow_gain` for each metre, and holds\n"
      "`heading` on the way. A point is reached within `tolerance`; after the last it stops, or, with `loop`, begins\n"
      "anew. It commands robot/*/command and robot/*/sideways, which robots with <mecanum> follow.";
  static constexpr auto phase = MUSTER_CONTROL;
  static constexpr Param params[] = {
      reference("robot", "robot", "the robot it steers").required(),
      file("path", "way points x[m],y[m]").required(),
      real("speed", 0.3, 0, 10, "m/s", "along the way"),
      real("slow_gain", 2, 0, 100, "1/s", "speed for each metre of distance"),
      real("heading", 0, -10, 10, "rad", "that it holds"),
      real("turn_gain", 2, 0, 100, "1/s", "turn rate for each radian of its error"),
      real("turn_speed", 1, 0, 10, "rad/s", "largest turn rate"),
      real("tolerance", 0.02, 1e-6, 10, "m", "a way point is reached within this distance"),
      flag("loop", false, "begin anew after the last way point")};

  struct Progress {
    static constexpr const char* columns = "next reached";
    double next, reached;  // index of the next way point, from 0; number of those reached
  };

  explicit ControlStrafe(Setup& s)
      : speed(s.value("speed")),
        slow_gain(s.value("slow_gain")),
        heading(s.value("heading")),
        turn_gain(s.value("turn_gain")),
        turn_speed(s.value("turn_speed")),
        tolerance(s.value("tolerance")),
        loop(s.value("loop")),
        path(s.file<Waypoint>("path")),
        odometry(s.read<Odometry>("robot/{robot}/odometry")),
        command(s.write<Command>("robot/{robot}/command")),
        sideways(s.write<Sideways>("robot/{robot}/sideways")),
        progress(s.write<Progress>("self/progress")) {
    expect_rollers(s);
  }

  static void expect_rollers(const Setup& s) {
    const auto row = static_cast<uint32_t>(s.param("robot"));
    const description::WorldRobots robots(s, description::Meshes::skip);
    const auto* robot = robots.of(row + 1.0);
    if (robot && robot->drive && robot->drive->mecanum) return;
    throw BadInput(model_in_words(s) +
                   " has no wheels with rollers (<mecanum>), so that it cannot go sideways; expected "
                   "<control.waypoint/>, which turns" +
                   or_a_model(s, "<mecanum", "has them"));
  }

  void step(const Step& k) const {
    const auto points = k[path];
    const Odometry& here = *k[odometry];
    Progress now = *k.last(progress);
    const auto next = [&] { return static_cast<std::size_t>(now.next); };
    if (next() < points.size() && Roadmap::distance({here.x, here.y}, points[next()]) <= k[tolerance]) {
      ++now.next;
      ++now.reached;
    }
    // Also beyond the last: before a swap the path may have been longer.
    if (next() >= points.size() && k[loop] != 0) now.next = 0;
    *k[progress] = now;
    *k[command] = {0, Turning{k[turn_gain], k[turn_speed]}.rate(turn_to(k[heading], here.yaw))};
    *k[sideways] = {0};
    if (next() >= points.size()) return;
    const double dx = points[next()].x - here.x, dy = points[next()].y - here.y, away = std::hypot(dx, dy);
    if (away == 0) return;
    const double v = std::min(k[speed], k[slow_gain] * away) / away, c = std::cos(here.yaw), s = std::sin(here.yaw);
    k[command]->v = v * (c * dx + s * dy);
    k[sideways]->v = v * (c * dy - s * dx);
  }

  Value speed, slow_gain, heading, turn_gain, turn_speed, tolerance, loop;
  In<Waypoint> path;
  In<Odometry> odometry;
  Out<Command> command;
  Out<Sideways> sideways;
  Out<Progress> progress;
};

}  // namespace

MUSTER_PLUGIN_IS(ControlStrafe)
