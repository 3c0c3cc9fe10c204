// Motion capture: pose of each robot as measured by cameras in the room.
#include <muster/plugin.hpp>

#include "attitude_law.hpp"

namespace {

using namespace muster;

struct RobotsMocap {
  static constexpr auto id = "robots.mocap/1";
  static constexpr auto summary = "poses and velocities as a motion capture system sees them";
  static constexpr auto manual =
      "Each robot's true place, roll, pitch, yaw and velocity, with white Gaussian noise of its own on each number: "
      "`place`\n"
      "on each coordinate, `angle` on each angle, `speed` on each component of the velocity. `every` gives its rate. "
      "Where\n"
      "the room is, occlusion and delay are not modelled. Player's position3d.";
  static constexpr auto phase = MUSTER_SENSE;
  static constexpr Param params[] = {
      real("place", 0, 0, 10, "m", "standard deviation of a coordinate").free(),
      real("angle", 0, 0, 3, "rad", "standard deviation of roll, pitch and yaw").free(),
      real("speed", 0, 0, 10, "m/s", "standard deviation of a component of the velocity").free()};

  explicit RobotsMocap(Setup& s)
      : place(s.value("place")),
        angle(s.value("angle")),
        speed(s.value("speed")),
        stream(s.stream("mocap")),
        pose(s.read<Pose>("robot/*/pose")),
        twist(s.read<Twist>("robot/*/twist")),
        seen(s.write<Position3d>("robot/*/position3d", MUSTER_SENSED)) {}

  void step(const Step& k) const {
    for (std::size_t i = 0; i < k[seen].size(); ++i) {
      const Pose& p = k[pose][i];
      const Twist& t = k[twist][i];
      const Angles a = angles_of({p.qw, p.qx, p.qy, p.qz});
      const auto noise = [&](Value deviation, unsigned number) {
        if (k.expected() || k[deviation] == 0) return 0.0;
        return k[deviation] * stream.of(k.key("robot", i)).normal(k.tick(), number);
      };
      k[seen][i] = {p.x + noise(place, 0),    p.y + noise(place, 1),     p.z + noise(place, 2),
                    a.roll + noise(angle, 3), a.pitch + noise(angle, 4), a.yaw + noise(angle, 5),
                    t.vx + noise(speed, 6),   t.vy + noise(speed, 7),    t.vz + noise(speed, 8)};
    }
  }

  Value place, angle, speed;
  Stream stream;
  In<Pose> pose;
  In<Twist> twist;
  Out<Position3d> seen;
};

}  // namespace

MUSTER_PLUGIN_IS(RobotsMocap)
