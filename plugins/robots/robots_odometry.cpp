// Where each robot believes to be: dead reckoning from the angles its wheels turned. And whether they turn as asked.
#include <algorithm>
#include <cmath>

#include "dead_reckoning.hpp"
#include "description/world_robots.hpp"

namespace {

using namespace muster;
using description::WorldRobots;

struct RobotsOdometry {
  static constexpr auto id = "robots.odometry/1";
  static constexpr auto summary = "dead reckoning from wheel angles, from the true pose at the start on";
  static constexpr auto manual =
      "Between two readings the wheels are taken to keep the ratio of their rates: a circular arc, exactly. `noise`\n"
      "is the standard deviation of the error that a wheel's reading gathers while it turns by one radian; the\n"
      "variance grows with the angle turned (after Chong and Kleeman, ICRA 1997), so it does not depend on the\n"
      "tick. A robot starts, also one that joins later, knowing its true pose. Slip is not seen: that is the point\n"
      "of it. Whenever `count` of robot/*/odometry_reset changes, it goes on from the place and heading given there.\n"
      "`robot/*/stall` is 1 while a wheel turns at less than half of the rate that its motor is asked for\n"
      "throughout the tick: it pushes against something and is too weak. A wheel that slips turns, and does not stall.";
  static constexpr auto phase = MUSTER_SENSE;
  static constexpr Param params[] = {
      real("noise", 0, 0, 1, "rad", "standard deviation of a wheel's reading after one radian").free()};

  // The angles of the last reading. A robot that joins as a copy of another brings that one's `of`, and starts anew.
  struct Seen {
    static constexpr const char* columns = "of model left[rad] right[rad] resets";
    // of: 1 + the robot's row; model: as in description::Model; resets: the last `count`
    double of, model, left, right, resets;
  };

  explicit RobotsOdometry(Setup& s)
      : noise(s.value("noise")),
        stream(s.stream("odometry")),
        robots(s, description::Meshes::skip),
        wheels(s.read<Wheels>("robot/*/wheels")),
        pose(s.read<Pose>("robot/*/pose")),
        drive(s.read_if_any<Drive>("robot/*/drive")),
        reset(s.read_if_any<OdometryReset>("robot/*/odometry_reset")),
        odometry(s.write<Odometry>("robot/*/odometry", MUSTER_SENSED)),
        stall(s.write<Stall>("robot/*/stall", MUSTER_SENSED)),
        seen(s.write<Seen>("robot/*/odometry_seen")) {}

  void step(const Step& k) const {
    const auto asked = k[drive];
    const auto resets = k[reset];
    for (std::size_t i = 0; i < k[odometry].size(); ++i) {
      const Wheels& now = k[wheels][i];
      const Seen& before = k.last(seen)[i];
      const Seen next{static_cast<double>(i + 1), WorldRobots::model_of(before.model, i), now.left, now.right,
                      i < resets.size() ? resets[i].count : before.resets};
      if (before.of != next.of) {
        const Pose& at = k[pose][i];
        k[odometry][i] = {at.x, at.y, yaw_of(at), 0, 0};
      } else {
        k[odometry][i] = moved(k, i, robots.drive_of(next.model), now.left - before.left, now.right - before.right);
      }
      if (next.resets != before.resets && before.of == next.of) start_from(k[odometry][i], resets[i]);
      k[seen][i] = next;
      const bool stands = i < asked.size() && k.alive("robot", i) && stalls(asked[i], now, k.dt());
      k[stall][i].stalled = stands ? 1 : 0;
    }
  }

  static void start_from(Odometry& at, const OdometryReset& place) {
    at.x = place.x;
    at.y = place.y;
    at.yaw = place.yaw;
  }

  Odometry moved(const Step& k, std::size_t i, const description::DifferentialDrive* motors, double left,
                 double right) const {
    Odometry at = k.last(odometry)[i];
    at.v = at.w = 0;
    if (!motors || !k.alive("robot", i)) return at;
    left += error(k, i, 0, left);
    right += error(k, i, 1, right);
    const double forward = motors->forward(left, right), turned = motors->turn(left, right);
    roll(at, forward, turned);
    at.v = forward / k.dt();
    at.w = turned / k.dt();
    return at;
  }

  static bool stalls(const Drive& asked, const Wheels& now, double dt) {
    return stalls(asked.left, asked.left + dt * asked.left_rate, now.left_rate) ||
           stalls(asked.right, asked.right + dt * asked.right_rate, now.right_rate);
  }

  // A wheel that is asked for `from` at the tick's start and `to` at its end. One that is to turn back may stand.
  static bool stalls(double from, double to, double rate) {
    if (from * to <= 0) return false;
    return std::copysign(1.0, from) * rate < std::min(std::abs(from), std::abs(to)) / 2;
  }

  double error(const Step& k, std::size_t robot, unsigned wheel, double turned) const {
    if (k.expected() || k[noise] == 0 || turned == 0) return 0;
    return k[noise] * std::sqrt(std::abs(turned)) * stream.of(k.key("robot", robot)).normal(k.tick(), wheel);
  }

  Value noise;
  Stream stream;
  WorldRobots robots;
  In<Wheels> wheels;
  In<Pose> pose;
  In<Drive> drive;
  In<OdometryReset> reset;
  Out<Odometry> odometry;
  Out<Stall> stall;
  Out<Seen> seen;
};

}  // namespace

MUSTER_PLUGIN_IS(RobotsOdometry)
