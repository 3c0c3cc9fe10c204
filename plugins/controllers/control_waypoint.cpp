// Drives from way point to way point by a robot's own odometry.
#include <muster/plugin.hpp>

#include "plugins/heading.hpp"
#include "roadmap.hpp"

namespace {

using namespace muster;

struct ControlWaypoint {
  static constexpr auto id = "control.waypoint/2";
  static constexpr auto summary = "drives a robot through way points by its own odometry";
  static constexpr auto manual =
      "The robot turns towards the next way point in proportion to the bearing and drives with its cosine; it turns\n"
      "on the spot while the point lies behind. A point is reached within `tolerance`; after the last it stops, or,\n"
      "with `loop`, begins anew. It drives where it believes to be: drift of the odometry is drift of the robot.";
  static constexpr auto phase = MUSTER_CONTROL;
  static constexpr Param params[] = {
      reference("robot", "robot", "the robot it steers").required(),
      file("path", "way points x[m],y[m]").required(),
      real("speed", 0.3, 0, 10, "m/s", "forward speed"),
      real("turn_gain", 2, 0, 100, "1/s", "turn rate for each radian of bearing"),
      real("turn_speed", 1, 0, 10, "rad/s", "largest turn rate"),
      real("tolerance", 0.05, 1e-6, 10, "m", "a way point is reached within this distance"),
      flag("loop", false, "begin anew after the last way point")};

  struct Progress {
    static constexpr const char* columns = "next reached";
    double next, reached;  // index of the next way point, from 0; number of those reached
  };

  explicit ControlWaypoint(Setup& s)
      : speed(s.value("speed")),
        turn_gain(s.value("turn_gain")),
        turn_speed(s.value("turn_speed")),
        tolerance(s.value("tolerance")),
        loop(s.value("loop")),
        path(s.file<Waypoint>("path")),
        odometry(s.read<Odometry>("robot/{robot}/odometry")),
        command(s.write<Command>("robot/{robot}/command")),
        progress(s.write<Progress>("self/progress")) {}

  void step(const Step& k) const {
    const auto points = k[path];
    const Waypoint here{k[odometry]->x, k[odometry]->y};
    Progress now = *k.last(progress);
    const auto next = [&] { return static_cast<std::size_t>(now.next); };
    if (next() < points.size() && Roadmap::distance(here, points[next()]) <= k[tolerance]) {
      ++now.next;
      ++now.reached;
    }
    // Also beyond the last: before a swap the path may have been longer.
    if (next() >= points.size() && k[loop] != 0) now.next = 0;
    *k[progress] = now;
    *k[command] = {0, 0};
    if (next() >= points.size()) return;
    const Waypoint& point = points[next()];
    *k[command] = towards(*k[odometry], point.x, point.y, k[speed], {k[turn_gain], k[turn_speed]});
  }

  Value speed, turn_gain, turn_speed, tolerance, loop;
  In<Waypoint> path;
  In<Odometry> odometry;
  Out<Command> command;
  Out<Progress> progress;
};

}  // namespace

MUSTER_PLUGIN_IS(ControlWaypoint)
