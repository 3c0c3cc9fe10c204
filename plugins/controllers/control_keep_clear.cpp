// Stops a robot before obstacles that its laser detects.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "description/world_robots.hpp"

namespace {

using namespace muster;
using description::WorldRobots;

struct ControlKeepClear {
  static constexpr auto id = "control.keep_clear/1";
  static constexpr auto summary = "slows a robot down before what its laser sees ahead";
  static constexpr auto manual =
      "A stage of a robot's commands: whoever steers it, the forward speed stays below what `deceleration` can take\n"
      "away before the nearest place that its first laser sees in its way, as wide as `width`, is `clearance` before "
      "its\n"
      "origin. Since the last scan the robot is taken to have come nearer as fast as it was asked to. Turning and\n"
      "driving backwards are let through.";
  static constexpr auto phase = MUSTER_CONTROL;
  static constexpr Param params[] = {reference("robot", "robot", "the robot it watches over").required(),
                                     real("clearance", 0.3, 0, 100, "m", "from the robot's origin to what is ahead"),
                                     real("width", 0.35, 0.001, 100, "m", "of the way that must be free"),
                                     real("deceleration", 0.5, 0.001, 100, "m/s2", "with which it slows down")};

  struct Ahead {
    static constexpr const char* columns = "free[m]~ v[m/s]";
    double free, v;  // free distance ahead of the robot's origin; commanded speed
  };

  explicit ControlKeepClear(Setup& s)
      : clearance(s.value("clearance")),
        width(s.value("width")),
        deceleration(s.value("deceleration")),
        scan(s.read<Scan>("scan/{robot}/message")),
        command(s.modify<Command>("robot/{robot}/command")),
        ahead(s.write<Ahead>("self/ahead")) {
    WorldRobots(s, description::Meshes::skip).require_laser(s, s.param("robot"));
  }

  void step(const Step& k) const {
    double free = k.last(ahead)->free;
    for (std::size_t i = 0; i < k[scan].size(); ++i) {
      if (k[scan][i].sensor == 0) free = free_way(k, i) - gone_since(k, k[scan][i].t);
    }
    // The highest speed v that, a tick later, leaves enough distance to stop: v2 = 2 a (left - v dt).
    const double left = std::max(0.0, free - k[clearance]), a = k[deceleration], change = a * k.dt();
    const double most = std::sqrt(change * change + 2 * a * left) - change;
    *k[command] = *k.before(command);
    k[command]->v = std::min(k[command]->v, most);
    const double v = k[command]->v;
    *k[ahead] = {std::max(0.0, free - (k.last(ahead)->v + v) / 2 * k.dt()), v};
  }

  // Distance covered from a scan to the last tick. The last scan is a tick old; older ones were read late.
  double gone_since(const Step& k, double scanned) const {
    const double tick = k.time() / static_cast<double>(k.tick());
    return k.last(ahead)->v * std::max(0.0, k.time() - tick - scanned);
  }

  // Distance to the nearest point of a scan in the robot's path.
  double free_way(const Step& k, std::size_t row) const {
    const Scan& seen = k[scan][row];
    const Eigen::Isometry3d at =
        Eigen::Translation3d(seen.at_x, seen.at_y, seen.at_z) * Eigen::Quaterniond(seen.qw, seen.qx, seen.qy, seen.qz);
    const std::string_view ranges = k.bytes(scan, row, Scan::payload_column);
    double free = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < ranges.size() / sizeof(double); ++i) {
      double range;
      std::memcpy(&range, ranges.data() + i * sizeof range, sizeof range);
      if (range == std::numeric_limits<double>::infinity()) continue;
      const double angle = seen.min_angle + static_cast<double>(i) * seen.step;
      const Eigen::Vector3d way = at.linear() * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0);
      const bool is_too_near = std::isinf(range);  // the distance is unknown: taken as 0, at the laser itself
      const Eigen::Vector3d place = at.translation() + (is_too_near ? 0 : range) * way;
      const bool is_ahead = is_too_near ? way.x() > 0 : place.x() > 0;
      if (is_ahead && std::abs(place.y()) < k[width] / 2) free = std::min(free, std::max(0.0, place.x()));
    }
    return free;
  }

  Value clearance, width, deceleration;
  In<Scan> scan;
  Stage<Command> command;
  Out<Ahead> ahead;
};

}  // namespace

MUSTER_PLUGIN_IS(ControlKeepClear)
