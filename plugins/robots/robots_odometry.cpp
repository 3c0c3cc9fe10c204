// Odometry: dead reckoning from the turns of wheels or legs, and detection of wheels that stall.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "dead_reckoning.hpp"
#include "description/world_robots.hpp"
#include "walking.hpp"

namespace {

using namespace muster;
using description::WorldRobots;

struct RobotsOdometry {
  static constexpr auto id = "robots.odometry/3";
  static constexpr auto summary =
      "dead reckoning from the angles of wheels or legs, from the true pose at the start on";
  static constexpr auto manual =
      "Between two readings the wheels are taken to keep the ratio of their rates: a circular arc, exactly. A robot "
      "that\n"
      "walks is taken to be carried by the tripod that holds it higher, on legs that do not slip, but that it\n"
      "turns by `turn_share` of what its strides make: feet slip in turns (effective track: Mandow et al., IROS "
      "2007).\n"
      "`noise` is the standard deviation of the error that a wheel's or leg's reading gathers while it turns by one "
      "radian; the\n"
      "variance grows with the angle turned (after Chong and Kleeman, ICRA 1997), so it does not depend on the\n"
      "tick. A robot starts, also one that joins later, knowing its true pose. Slip is not seen: that is the point\n"
      "of it. Whenever `count` of robot/*/odometry_reset changes, it goes on from the place and heading given there.\n"
      "`robot/*/stall` is 1 while a wheel turns at less than half of the rate that its motor is asked for\n"
      "throughout the tick: it pushes against something and is too weak. A wheel that slips turns, and does not stall.";
  static constexpr auto phase = MUSTER_SENSE;
  static constexpr Param params[] = {
      real("noise", 0, 0, 1, "rad", "standard deviation of a wheel's or leg's reading after one radian").free(),
      real("turn_share", 1, 0.1, 1, "", "of the turn that strides make, what a robot on legs turns").free()};

  // The angles of the last reading. A robot that joins as a copy of another has that one's `of`, and starts anew.
  struct Seen {
    static constexpr const char* columns = "of model left[rad] right[rad] resets";
    // of: 1 + the robot's row; model: as in description::Model; resets: the last `count`
    double of, model, left, right, resets;
  };

  struct SeenRear {
    static constexpr const char* columns = "left[rad] right[rad]";
    double left, right;
  };

  struct SeenLegs {
    static constexpr const char* columns = "angle1[rad] angle2[rad] angle3[rad] angle4[rad] angle5[rad] angle6[rad]";
    double angle[6];
  };

  explicit RobotsOdometry(Setup& s)
      : noise(s.value("noise")),
        turn_share(s.value("turn_share")),
        stream(s.stream("odometry")),
        robots(s, description::Meshes::skip),
        wheels(s.read<Wheels>("robot/*/wheels")),
        pose(s.read<Pose>("robot/*/pose")),
        drive(s.read_if_any<Drive>("robot/*/drive")),
        reset(s.read_if_any<OdometryReset>("robot/*/odometry_reset")),
        odometry(s.write<Odometry>("robot/*/odometry", MUSTER_SENSED)),
        stall(s.write<Stall>("robot/*/stall", MUSTER_SENSED)),
        seen(s.write<Seen>("robot/*/odometry_seen")) {
    if (robots.any_mecanum()) {
      rear_wheels = s.read_if_any<Wheels>("robot/*/rear_wheels");
      rear_drive = s.read_if_any<Drive>("robot/*/rear_drive");
      seen_rear = s.write<SeenRear>("robot/*/odometry_rear");
    }
    if (!robots.any_walks()) return;
    legs = s.read_if_any<Legs>("robot/*/legs");
    seen_legs = s.write<SeenLegs>("robot/*/odometry_legs");
  }

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
        k[odometry][i] = moved(k, i, next.model, now.left - before.left, now.right - before.right);
      }
      if (next.resets != before.resets && before.of == next.of) start_from(k[odometry][i], resets[i]);
      k[seen][i] = next;
      if (seen_rear) {
        const bool has_rear = i < k[*rear_wheels].size();
        k[*seen_rear][i] = has_rear ? SeenRear{k[*rear_wheels][i].left, k[*rear_wheels][i].right} : SeenRear{0, 0};
      }
      if (robots.any_walks()) k[seen_legs][i] = i < k[legs].size() ? angles_of(k[legs][i]) : SeenLegs{};
      const bool stands =
          i < asked.size() && k.alive("robot", i) && (stalls(asked[i], now, k.dt()) || rear_stalls(k, i));
      k[stall][i].stalled = stands ? 1 : 0;
    }
  }

  static SeenLegs angles_of(const Legs& turned) {
    SeenLegs result;
    std::copy(std::begin(turned.angle), std::end(turned.angle), result.angle);
    return result;
  }

  static void start_from(Odometry& at, const OdometryReset& place) {
    at.x = place.x;
    at.y = place.y;
    at.yaw = place.yaw;
  }

  // Odometry after its wheels have turned this far.
  Odometry moved(const Step& k, std::size_t i, double model, double left, double right) const {
    Odometry at = k.last(odometry)[i];
    at.v = at.w = 0;
    if (!k.alive("robot", i)) return at;
    if (const auto* motors = robots.drive_of(model)) {
      left += error(k, i, 0, left);
      right += error(k, i, 1, right);
      if (motors->mecanum && seen_rear && i < k[*rear_wheels].size())
        slide(k, i, at, *motors->mecanum, left, right);
      else if (motors->steering)
        go_by_axle(k, at, motors->steering->rear_axle, motors->forward(left, right), motors->turn(left, right));
      else
        go(k, at, motors->forward(left, right), motors->turn(left, right));
    } else if (const auto* walks = robots.legs_of(model); walks && i < k[legs].size()) {
      const Sides sides = strides(k, i, *walks);
      go(k, at, (sides.left + sides.right) / 2, k[turn_share] * (sides.right - sides.left) / walks->track());
    }
    return at;
  }

  static void go(const Step& k, Odometry& at, double forward, double turned) {
    roll(at, forward, turned);
    at.v = forward / k.dt();
    at.w = turned / k.dt();
  }

  // The rear axle of a car goes along arcs.
  static void go_by_axle(const Step& k, Odometry& at, double axle, double forward, double turned) {
    at.x += axle * std::cos(at.yaw), at.y += axle * std::sin(at.yaw);
    go(k, at, forward, turned);
    at.x -= axle * std::cos(at.yaw), at.y -= axle * std::sin(at.yaw);
  }

  void slide(const Step& k, std::size_t i, Odometry& at, const description::Mecanum& wheeled, double front_left,
             double front_right) const {
    const SeenRear& before = k.last(*seen_rear)[i];
    double rear_left = k[*rear_wheels][i].left - before.left, rear_right = k[*rear_wheels][i].right - before.right;
    rear_left += error(k, i, 2, rear_left);
    rear_right += error(k, i, 3, rear_right);
    const auto way = wheeled.motion({front_left, front_right, rear_left, rear_right});
    roll(at, way.vx, way.vy, way.w);
    at.v = way.vx / k.dt();
    at.w = way.w / k.dt();
  }

  Sides strides(const Step& k, std::size_t i, const description::LegDrive& walks) const {
    const auto& from = k.last(seen_legs)[i].angle;
    std::array<double, 6> to;
    for (unsigned leg = 0; leg < 6; ++leg) {
      const double turned = k[legs][i].angle[leg] - from[leg];
      to[leg] = from[leg] + turned + error(k, i, leg, turned);
    }
    return walked(walks, from, to.data());
  }

  bool rear_stalls(const Step& k, std::size_t i) const {
    if (!rear_drive || i >= k[*rear_drive].size() || i >= k[*rear_wheels].size()) return false;
    return stalls(k[*rear_drive][i], k[*rear_wheels][i], k.dt());
  }

  static bool stalls(const Drive& asked, const Wheels& now, double dt) {
    return stalls(asked.left, asked.left + dt * asked.left_rate, now.left_rate) ||
           stalls(asked.right, asked.right + dt * asked.right_rate, now.right_rate);
  }

  // True if a wheel commanded from `from` at the tick's start to `to` at its end stalls. One that is to reverse may be
  // at rest.
  static bool stalls(double from, double to, double rate) {
    if (from * to <= 0) return false;
    return std::copysign(1.0, from) * rate < std::min(std::abs(from), std::abs(to)) / 2;
  }

  double error(const Step& k, std::size_t robot, unsigned wheel, double turned) const {
    if (k.expected() || k[noise] == 0 || turned == 0) return 0;
    return k[noise] * std::sqrt(std::abs(turned)) * stream.of(k.key("robot", robot)).normal(k.tick(), wheel);
  }

  Value noise, turn_share;
  Stream stream;
  WorldRobots robots;
  In<Wheels> wheels;
  In<Pose> pose;
  In<Drive> drive;
  In<OdometryReset> reset;
  Out<Odometry> odometry;
  Out<Stall> stall;
  Out<Seen> seen;
  std::optional<In<Wheels>> rear_wheels;  // if any robot has rollers
  std::optional<In<Drive>> rear_drive;
  std::optional<Out<SeenRear>> seen_rear;
  In<Legs> legs{};            // if any robot walks
  Out<SeenLegs> seen_legs{};  // if any robot walks
};

}  // namespace

MUSTER_PLUGIN_IS(RobotsOdometry)
