// Where each robot believes to be: dead reckoning from the angles its wheels turned.
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
      "of it.";
  static constexpr auto phase = MUSTER_SENSE;
  static constexpr Param params[] = {
      real("noise", 0, 0, 1, "rad", "standard deviation of a wheel's reading after one radian").free()};

  // The angles of the last reading. A robot that joins as a copy of another brings that one's `of`, and starts anew.
  struct Seen {
    static constexpr const char* columns = "of model left[rad] right[rad]";
    double of, model, left, right;  // of: 1 + the robot's row; model: as in description::Model
  };

  explicit RobotsOdometry(Setup& s)
      : noise(s.value("noise")),
        stream(s.stream("odometry")),
        robots(s, description::Meshes::skip),
        wheels(s.read<Wheels>("robot/*/wheels")),
        pose(s.read<Pose>("robot/*/pose")),
        odometry(s.write<Odometry>("robot/*/odometry", MUSTER_SENSED)),
        seen(s.write<Seen>("robot/*/odometry_seen")) {}

  void step(const Step& k) const {
    for (std::size_t i = 0; i < k[odometry].size(); ++i) {
      const Wheels& now = k[wheels][i];
      const Seen& before = k.last(seen)[i];
      const Seen next{static_cast<double>(i + 1), WorldRobots::model_of(before.model, i), now.left, now.right};
      if (before.of != next.of) {
        const Pose& at = k[pose][i];
        k[odometry][i] = {at.x, at.y, yaw_of(at), 0, 0};
      } else {
        k[odometry][i] = moved(k, i, robots.drive_of(next.model), now.left - before.left, now.right - before.right);
      }
      k[seen][i] = next;
    }
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

  double error(const Step& k, std::size_t robot, unsigned wheel, double turned) const {
    if (k.expected() || k[noise] == 0 || turned == 0) return 0;
    return k[noise] * std::sqrt(std::abs(turned)) * stream.of(k.key("robot", robot)).normal(k.tick(), wheel);
  }

  Value noise;
  Stream stream;
  WorldRobots robots;
  In<Wheels> wheels;
  In<Pose> pose;
  Out<Odometry> odometry;
  Out<Seen> seen;
};

}  // namespace

MUSTER_PLUGIN_IS(RobotsOdometry)
