// Follows way points in space, on schedule.
#include <cstdio>
#include <muster/plugin.hpp>
#include <string>

#include "plugins/periods.hpp"
#include "plugins/table_times.hpp"
#include "robot_model.hpp"
#include "timed_path.hpp"

namespace {

using namespace muster;

struct ControlPath3d {
  static constexpr auto id = "control.path3d/1";
  static constexpr auto summary = "leads a flying robot along way points, on time";
  static constexpr auto manual =
      "The way is a function of time: from `start` on, from way point to way point at rest, speeding up and slowing "
      "down by\n"
      "`acceleration`, at most at `speed`, with `wait` at each; one way point is a place to hover at. The velocity "
      "asked "
      "for is\n"
      "that of the way, plus `gain` for each metre that position3d is off, at most `catch_up`; with it goes the way's "
      "acceleration,\n"
      "along the ground that of `lead` later, since a robot tilts first. The turn rate is `heading_gain` for each "
      "radian\n"
      "off `heading`. A position3d for control.velocity3d.";
  static constexpr auto phase = MUSTER_CONTROL;
  static constexpr Param params[] = {
      reference("robot", "robot", "the robot it leads").required(),
      file("path", "way points x[m],y[m],z[m]").required(),
      real("start", 0, 0, 1e9, "s", "when its wait at the first way point begins"),
      real("speed", 1, 1e-3, 100, "m/s", "on the way"),
      real("acceleration", 3, 1e-3, 100, "m/s2", "from and to rest"),
      real("wait", 0, 0, 1e9, "s", "at each way point"),
      flag("loop", false, "from the last way point to the first, and so on"),
      real("gain", 2, 0, 100, "1/s", "velocity for each metre off the way"),
      real("catch_up", 1, 0, 100, "m/s", "the most of it"),
      real("lead", 0.12, 0, 10, "s", "what the robot needs to tilt"),
      real("heading", 0, -100, 100, "rad", "from east to north"),
      real("heading_gain", 1, 0, 100, "1/s", "turn rate for each radian off the heading")};

  explicit ControlPath3d(Setup& s)
      : start(s.value("start")),
        speed(s.value("speed")),
        acceleration(s.value("acceleration")),
        wait(s.value("wait")),
        loop(s.value("loop")),
        gain(s.value("gain")),
        catch_up(s.value("catch_up")),
        lead(s.value("lead")),
        heading(s.value("heading")),
        heading_gain(s.value("heading_gain")),
        times(s, "path"),
        path(s.file<WayPoint3d>("path")),
        seen(s.read<Position3d>("robot/{robot}/position3d")),
        asked(s.write<Velocity3d>("robot/{robot}/velocity3d")) {
    const description::WorldRobots robots(s, description::Meshes::skip);
    const auto* robot = robots.of(s.param("robot") + 1);
    if (robot && !robot->quadrotor && (robot->drive || robot->legs))
      throw BadInput(model_in_words(s) + " is on the ground and does not fly; expected <control.waypoint/>" +
                     or_a_model(s, "<quadrotor", "flies"));
  }

  void step(const Step& k) const {
    if (is_first_step(k.time(), k.dt())) {
      warn_of_depth(k);
      warn_of_distance(k);
    }
    const auto way = [&](double t) {
      return timed_path(k[path], t - k[start], k[speed], k[acceleration], k[wait], k[loop] != 0);
    };
    const double now = k.time() * (1 - 1 / static_cast<double>(k.tick()));  // of the observation: the tick before
    const Reference here = way(now), ahead = way(now + k[lead]);
    const Vector off = {here.place[0] - k[seen]->x, here.place[1] - k[seen]->y, here.place[2] - k[seen]->z};
    const double distance = std::hypot(off[0], off[1], off[2]);
    const double pull = k[gain] * distance > k[catch_up] ? k[catch_up] / distance : k[gain];
    constexpr double whole_turn = 6.283185307179586;
    const double turn = std::remainder(k[heading] - k[seen]->yaw, whole_turn);
    *k[asked] = {here.velocity[0] + pull * off[0],
                 here.velocity[1] + pull * off[1],
                 here.velocity[2] + pull * off[2],
                 k[heading_gain] * turn,
                 ahead.acceleration[0],
                 ahead.acceleration[1],
                 here.acceleration[2]};
  }

  // Way points below the ground, as those of PX4, whose z is down.
  void warn_of_depth(const Step& k) const {
    std::size_t first = 0, below = 0;
    for (std::size_t i = 0; i < k[path].size(); ++i) {
      if (!(k[path][i].z < 0)) continue;
      if (below++ == 0) first = i;
    }
    if (below == 0) return;
    char z[64];
    std::snprintf(z, sizeof z, "z = %.6g m", k[path][first].z);
    k.event("warning: " + times.rows().at(first, "z") + z + " is below the ground" +
            (below > 1 ? ", in " + std::to_string(below) + " way points" : "") +
            "; is z down here, as in PX4 (NED)? expected metres up, and x east, y north");
  }

  // The first way point that is far away and out of reach in the run.
  void warn_of_distance(const Step& k) const {
    constexpr double far_off = 100, surely = 10;  // m; times the way in the run
    for (std::size_t i = 0; i < k[path].size(); ++i) {
      const WayPoint3d& p = k[path][i];
      const double away = std::hypot(p.x - k[seen]->x, p.y - k[seen]->y, p.z - k[seen]->z);
      if (!(times.until() > 0) || away < far_off || away < surely * times.until() * (k[speed] + k[catch_up])) continue;
      return k.event("warning: " + times.rows().at(i) + "a way point " + TableTimes::print(std::round(away)) +
                     " m away, where the robot does not come in the run of " + TableTimes::print(times.until()) +
                     " s; are these millimetres? expected metres");
    }
  }

  Value start, speed, acceleration, wait, loop, gain, catch_up, lead, heading, heading_gain;
  TableTimes times;
  In<WayPoint3d> path;
  In<Position3d> seen;
  Out<Velocity3d> asked;
};

}  // namespace

MUSTER_PLUGIN_IS(ControlPath3d)
